// SPDX-License-Identifier: MIT
#include "osgMultiRender/CppShaders.h"

#include <osgMultiRender/GlslSource.h>

#include <algorithm>
#include <cctype>

using namespace osgMultiRender;

namespace
{

/// Goes over a C++ text and joins adjacent literals.
class Literals
{
public:
    explicit Literals(const std::string& text) : _text(text) {}

    std::vector<std::string> read()
    {
        while (_at < _text.size())
            step();
        flush();
        return std::move(_found);
    }

private:
    bool starts(const char* with) const
    {
        return _text.compare(_at, std::char_traits<char>::length(with), with) == 0;
    }

    void passBehind(const char* end)
    {
        const std::size_t found = _text.find(end, _at);
        _at =
            found == std::string::npos ? _text.size() : found + std::char_traits<char>::length(end);
    }

    void step()
    {
        if (starts("//"))
            passBehind("\n");
        else if (starts("/*"))
            passBehind("*/");
        else if (starts("R\""))
            readRaw();
        else if (_text[_at] == '"')
            readPlain();
        else if (_text[_at] == '\'')
        {
            flush();
            for (++_at; _at < _text.size() && _text[_at] != '\''; ++_at)
                _at += _text[_at] == '\\';
            ++_at;
        }
        else if (_text[_at] == '#')
            passBehind(starts("#el") ? "#endif" : "\n"); // the first branch counts
        else
        {
            if (!std::isspace(static_cast<unsigned char>(_text[_at])))
                flush();
            ++_at;
        }
    }

    void readRaw()
    {
        const std::size_t open = _text.find('(', _at);
        if (open == std::string::npos)
        {
            _at = _text.size();
            return;
        }
        const std::string end = ")" + _text.substr(_at + 2, open - _at - 2) + "\"";
        const std::size_t close = std::min(_text.find(end, open), _text.size());
        _current += _text.substr(open + 1, close - open - 1);
        _at = close + end.size();
    }

    void readPlain()
    {
        for (++_at; _at < _text.size() && _text[_at] != '"'; ++_at)
            if (_text[_at] != '\\' || _at + 1 == _text.size())
                _current += _text[_at];
            else if (const char c = _text[++_at]; c != '\n') // a line that goes on
                _current += c == 'n' ? '\n' : c == 't' ? '\t' : c;
        ++_at;
    }

    void flush()
    {
        if (!_current.empty())
            _found.push_back(std::move(_current));
        _current.clear();
    }

    const std::string& _text;
    std::size_t _at = 0;
    std::string _current;
    std::vector<std::string> _found;
};

bool holdsAny(const std::string& text, std::initializer_list<const char*> words)
{
    for (const char* word : words)
        if (text.find(word) != std::string::npos)
            return true;
    return false;
}

GlslStage stageOf(const std::string& text)
{
    if (holdsAny(text, {"EmitVertex"}))
        return GlslStage::Geometry;
    if (holdsAny(text, {"layout(vertices"}))
        return GlslStage::TessellationControl;
    if (holdsAny(text, {"gl_TessCoord"}))
        return GlslStage::TessellationEvaluation;
    const bool isFragment = holdsAny(text, {"gl_FragColor", "gl_FragData", "gl_FragCoord"});
    return !isFragment && holdsAny(text, {"gl_Position", "gl_Vertex", "in vec4 osg_Vertex"})
               ? GlslStage::Vertex
               : GlslStage::Fragment;
}

} // namespace

std::vector<CppShader> shadersOfCpp(const std::string& text)
{
    std::vector<CppShader> shaders;
    for (const std::string& literal : Literals(text).read())
    {
        const bool isCompute = holdsAny(literal, {"local_size_x"});
        if (!isCompute && parseGlsl(literal).findFunction("main"))
            shaders.push_back({stageOf(literal), literal});
    }
    return shaders;
}
