// SPDX-License-Identifier: MIT
#pragma once

#include <osg/Light>
#include <osg/Matrix>
#include <osg/StateAttribute>

#include <vector>

namespace osgMultiRender
{

/// Stands in for lights numbered 8 or above, which GL does not know: applying it does nothing.
/// (Stock OSG hands such lights to GL, which answers GL_INVALID_ENUM.)
///
/// In the list of a view's positioned attributes one object stands for all of them: osg::State
/// looks at each attribute that was ever applied whenever it applies a StateSet.
class WithheldLights : public osg::StateAttribute
{
public:
    struct Positioned
    {
        osg::ref_ptr<const osg::Light> light;
        osg::ref_ptr<osg::RefMatrix> matrix; ///< To eye coordinates; null for identity.
    };

    WithheldLights() = default;
    explicit WithheldLights(unsigned int number) : _number(number) {}
    WithheldLights(const WithheldLights& other, const osg::CopyOp& copyop)
        : osg::StateAttribute(other, copyop), _number(other._number), _lights(other._lights)
    {
    }
    META_StateAttribute(osgMultiRender, WithheldLights, LIGHT)

    unsigned int getMember() const override { return _number; }
    int compare(const osg::StateAttribute& other) const override
    {
        COMPARE_StateAttribute_Types(WithheldLights, other)
                    COMPARE_StateAttribute_Parameter(_number) return this == &other
            ? 0
        : this < &other ? -1
                        : 1;
    }
    void apply(osg::State&) const override {}

    /// In the order in which GL would get them.
    std::vector<Positioned>& getLights() { return _lights; }
    const std::vector<Positioned>& getLights() const { return _lights; }

protected:
    ~WithheldLights() override = default;

private:
    unsigned int _number = 8;
    std::vector<Positioned> _lights;
};

} // namespace osgMultiRender
