// SPDX-License-Identifier: MIT
#pragma once

#include <osg/Light>
#include <osg/StateAttribute>

namespace osgMultiRender
{

/// Stands in for a Light numbered 8 or above, which GL does not know: applying it does nothing.
/// (Stock OSG hands such lights to GL, which answers GL_INVALID_ENUM.)
class WithheldLight : public osg::StateAttribute
{
public:
    WithheldLight() = default;
    explicit WithheldLight(const osg::Light* light, unsigned int number)
        : _light(light), _number(number)
    {
    }
    WithheldLight(const WithheldLight& other, const osg::CopyOp& copyop)
        : osg::StateAttribute(other, copyop), _light(other._light), _number(other._number)
    {
    }
    META_StateAttribute(osgMultiRender, WithheldLight, LIGHT)

    unsigned int getMember() const override { return _number; }
    int compare(const osg::StateAttribute& other) const override
    {
        COMPARE_StateAttribute_Types(WithheldLight, other)
        COMPARE_StateAttribute_Parameter(_number)
        COMPARE_StateAttribute_Parameter(_light)
        return 0;
    }
    void apply(osg::State&) const override {}

    const osg::Light* getLight() const { return _light.get(); }

protected:
    ~WithheldLight() override = default;

private:
    osg::ref_ptr<const osg::Light> _light;
    unsigned int _number = 0;
};

} // namespace osgMultiRender
