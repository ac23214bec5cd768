// SPDX-License-Identifier: MIT
#include <osgLabels/Chunkable.h>

#include <osg/Depth>
#include <osg/Geode>
#include <osg/Geometry>
#include <osg/MatrixTransform>
#include <osg/PositionAttitudeTransform>
#include <osg/Program>
#include <osg/StateSet>
#include <osg/TexGen>

#include <cstring>
#include <typeinfo>

namespace osgLabels
{

namespace
{

bool isOn(const osg::StateSet& stateSet, GLenum mode)
{
    const auto value = stateSet.getMode(mode);
    return !(value & osg::StateAttribute::INHERIT) && (value & osg::StateAttribute::ON);
}

bool isOff(const osg::StateSet& stateSet, GLenum mode)
{
    const auto value = stateSet.getMode(mode);
    return !(value & osg::StateAttribute::INHERIT) && !(value & osg::StateAttribute::ON);
}

bool isPlain(const osg::Node& node)
{
    const std::type_info& type = typeid(node);
    if (type == typeid(osg::MatrixTransform) || type == typeid(osg::PositionAttitudeTransform))
        return static_cast<const osg::Transform&>(node).getReferenceFrame() ==
               osg::Transform::RELATIVE_RF;
    return type == typeid(osg::Group) || type == typeid(osg::Geode) ||
           type == typeid(osg::Geometry) ||
           // Inventor's reader has a class of its own, which draws as osg::Geometry does.
           (node.asDrawable() && std::strstr(type.name(), "deprecated_osg"));
}

bool hasCallbacks(const osg::Node& node)
{
    const osg::Drawable* drawable = node.asDrawable();
    return node.getUpdateCallback() || node.getEventCallback() || node.getCullCallback() ||
           node.getComputeBoundingSphereCallback() ||
           (drawable && (drawable->getDrawCallback() || drawable->getComputeBoundingBoxCallback()));
}

template <typename Attributes> bool changes(const Attributes& attributes)
{
    for (const auto& [type, pair] : attributes)
        if (pair.first->getDataVariance() == osg::Object::DYNAMIC ||
            pair.first->getUpdateCallback() || pair.first->getEventCallback())
            return true;
    return false;
}

bool changes(const osg::StateSet& stateSet)
{
    if (stateSet.getDataVariance() == osg::Object::DYNAMIC || stateSet.getUpdateCallback() ||
        stateSet.getEventCallback() || changes(stateSet.getAttributeList()))
        return true;
    for (const auto& attributes : stateSet.getTextureAttributeList())
        if (changes(attributes))
            return true;
    return false;
}

bool usesLocalCoordinates(const osg::StateSet& stateSet)
{
    for (unsigned int unit = 0; unit < stateSet.getTextureAttributeList().size(); ++unit)
        if (const auto* texGen = static_cast<const osg::TexGen*>(
                stateSet.getTextureAttribute(unit, osg::StateAttribute::TEXGEN)))
            if (texGen->getMode() == osg::TexGen::OBJECT_LINEAR)
                return true;
    // Normals are scaled by what the modelview matrix scales.
    return isOn(stateSet, GL_RESCALE_NORMAL);
}

/// Whether the order of drawing shows.
bool isOrdered(const osg::StateSet& stateSet)
{
    const auto* depth =
        static_cast<const osg::Depth*>(stateSet.getAttribute(osg::StateAttribute::DEPTH));
    return stateSet.getRenderBinMode() != osg::StateSet::INHERIT_RENDERBIN_DETAILS ||
           isOn(stateSet, GL_BLEND) || isOn(stateSet, GL_STENCIL_TEST) ||
           isOn(stateSet, GL_COLOR_LOGIC_OP) || isOff(stateSet, GL_DEPTH_TEST) ||
           (depth && (!depth->getWriteMask() || (depth->getFunction() != osg::Depth::LESS &&
                                                 depth->getFunction() != osg::Depth::LEQUAL)));
}

} // namespace

const char* whyNotChunked(const osg::Node& node)
{
    if (!isPlain(node))
        return "other kinds of nodes";
    if (node.getNodeMask() != ~0u)
        return "node masks";
    if (hasCallbacks(node))
        return "callbacks";
    if (node.getDataVariance() == osg::Object::DYNAMIC)
        return "dynamic";
    const osg::StateSet* stateSet = node.getStateSet();
    if (!stateSet)
        return nullptr;
    const auto* program =
        static_cast<const osg::Program*>(stateSet->getAttribute(osg::StateAttribute::PROGRAM));
    if (program && program->getNumShaders())
        return "programs";
    if (changes(*stateSet))
        return "dynamic";
    if (isOrdered(*stateSet))
        return "order of drawing";
    return usesLocalCoordinates(*stateSet) ? "local coordinates" : nullptr;
}

} // namespace osgLabels
