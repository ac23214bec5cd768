// SPDX-License-Identifier: MIT
#include <osgMultiRender/VertexSnippet.h>

#include <algorithm>
#include <functional>

namespace osgMultiRender
{

VertexSnippet::VertexSnippet(const std::string& text)
    : _text(text), _content(std::max<std::uint64_t>(1, std::hash<std::string>()(text)))
{
}

VertexSnippet::VertexSnippet(const VertexSnippet& other, const osg::CopyOp& copyop)
    : osg::Program(other, copyop), _text(other._text), _content(other._content)
{
}

} // namespace osgMultiRender
