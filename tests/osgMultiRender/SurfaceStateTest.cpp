// SPDX-License-Identifier: MIT
#include <osgMultiRender/SurfaceState.h>

#include <osg/Fog>
#include <osg/LightModel>
#include <osg/Material>
#include <osg/ShadeModel>
#include <osg/State>
#include <osg/TexEnv>
#include <osg/TexMat>

#include <gtest/gtest.h>

#include <random>

using osgMultiRender::SurfaceState;
using Value = osg::StateAttribute::OverrideValue;

namespace
{

constexpr Value On = osg::StateAttribute::ON;
constexpr Value Off = osg::StateAttribute::OFF;
constexpr Value Override = osg::StateAttribute::OVERRIDE;
constexpr Value Protected = osg::StateAttribute::PROTECTED;

struct TrackedMode
{
    osg::StateAttribute::GLMode mode;
    std::uint32_t bit;
};

const TrackedMode Modes[] = {{GL_LIGHTING, SurfaceState::Lighting},
                             {GL_NORMALIZE, SurfaceState::Normalize},
                             {GL_RESCALE_NORMAL, SurfaceState::RescaleNormal},
                             {GL_FOG, SurfaceState::Fog},
                             {GL_LIGHT0, SurfaceState::Light0},
                             {GL_LIGHT0 + 7, SurfaceState::Light0 << 7},
                             {GL_CLIP_PLANE0, SurfaceState::ClipPlane0},
                             {GL_CLIP_PLANE0 + 5, SurfaceState::ClipPlane0 << 5}};

const TrackedMode TextureModes[] = {{GL_TEXTURE_2D, SurfaceState::Texture2D},
                                    {GL_TEXTURE_CUBE_MAP, SurfaceState::TextureCube},
                                    {GL_TEXTURE_GEN_S, SurfaceState::GenS},
                                    {GL_TEXTURE_GEN_Q, SurfaceState::GenQ}};

/// The modes and attributes on top of a real osg::State's stacks.
class TopOfState : public osg::State
{
public:
    bool isOn(osg::StateAttribute::GLMode mode) const { return top(_modeMap, mode); }

    bool isOn(unsigned int unit, osg::StateAttribute::GLMode mode) const
    {
        return unit < _textureModeMapList.size() && top(_textureModeMapList[unit], mode);
    }

    const osg::StateAttribute* get(osg::StateAttribute::Type type, unsigned int member = 0) const
    {
        return top(_attributeMap, type, member);
    }

    const osg::StateAttribute* get(unsigned int unit, osg::StateAttribute::Type type) const
    {
        return unit < _textureAttributeMapList.size() ? top(_textureAttributeMapList[unit], type, 0)
                                                      : nullptr;
    }

private:
    static bool top(const ModeMap& map, osg::StateAttribute::GLMode mode)
    {
        const auto found = map.find(mode);
        return found != map.end() && !found->second.valueVec.empty() &&
               (found->second.valueVec.back() & osg::StateAttribute::ON);
    }

    static const osg::StateAttribute* top(const AttributeMap& map, osg::StateAttribute::Type type,
                                          unsigned int member)
    {
        const auto found = map.find({type, member});
        return found == map.end() || found->second.attributeVec.empty()
                   ? nullptr
                   : found->second.attributeVec.back().first;
    }
};

osg::ref_ptr<osg::StateSet> randomStateSet(std::mt19937& random)
{
    const auto oneIn = [&random](unsigned int n) { return random() % n == 0; };
    const auto value = [&random] { return Value(random() % 8u); }; // ON, OVERRIDE, PROTECTED
    osg::ref_ptr<osg::StateSet> stateSet = new osg::StateSet;
    for (const TrackedMode& mode : Modes)
        if (oneIn(3))
            stateSet->setMode(mode.mode, value());
    for (unsigned int number : {8u, 9u, 300u, 16383u})
        if (oneIn(3))
            stateSet->setMode(GL_LIGHT0 + number, value());
    for (unsigned int unit = 0; unit < 6; ++unit)
    {
        for (const TrackedMode& mode : TextureModes)
            if (oneIn(4))
                stateSet->setTextureMode(unit, mode.mode, value());
        if (oneIn(4))
            stateSet->setTextureAttribute(unit, new osg::TexEnv, value());
        if (oneIn(4))
            stateSet->setTextureAttribute(unit, new osg::TexMat, value());
    }
    if (oneIn(3))
        stateSet->setAttribute(new osg::Material, value());
    if (oneIn(3))
        stateSet->setAttribute(new osg::Fog, value());
    if (oneIn(3))
        stateSet->setAttribute(new osg::LightModel, value());
    if (oneIn(3))
        stateSet->setAttribute(new osg::ShadeModel, value());
    if (oneIn(3))
        stateSet->setAttribute(new osg::Light(random() % 8), value());
    return stateSet;
}

void expectSame(const SurfaceState& state, const TopOfState& real)
{
    for (const TrackedMode& mode : Modes)
        ASSERT_EQ((state.getModes() & mode.bit) != 0, real.isOn(mode.mode)) << mode.mode;
    for (unsigned int number : {0u, 7u, 8u, 9u, 10u, 300u, 16383u})
        ASSERT_EQ(state.isLightOn(number), real.isOn(GL_LIGHT0 + number)) << "light " << number;
    for (unsigned int unit = 0; unit < SurfaceState::MaxTextureUnits; ++unit)
    {
        for (const TrackedMode& mode : TextureModes)
            ASSERT_EQ((state.getTextureModes(unit) & mode.bit) != 0, real.isOn(unit, mode.mode));
        ASSERT_EQ(state.get(unit, SurfaceState::TexEnv),
                  real.get(unit, osg::StateAttribute::TEXENV));
        ASSERT_EQ(state.get(unit, SurfaceState::TexMat),
                  real.get(unit, osg::StateAttribute::TEXMAT));
    }
    const bool beyond = real.isOn(4, GL_TEXTURE_2D) || real.isOn(4, GL_TEXTURE_CUBE_MAP) ||
                        real.isOn(5, GL_TEXTURE_2D) || real.isOn(5, GL_TEXTURE_CUBE_MAP);
    ASSERT_EQ(state.usesUnitsBeyond(), beyond);
    ASSERT_EQ(state.get(SurfaceState::Material), real.get(osg::StateAttribute::MATERIAL));
    ASSERT_EQ(state.get(SurfaceState::FogAttribute), real.get(osg::StateAttribute::FOG));
    ASSERT_EQ(state.get(SurfaceState::LightModel), real.get(osg::StateAttribute::LIGHTMODEL));
    ASSERT_EQ(state.get(SurfaceState::ShadeModel), real.get(osg::StateAttribute::SHADEMODEL));
    for (unsigned int number = 0; number < SurfaceState::MaxGLLights; ++number)
        ASSERT_EQ(state.getLight(number), real.get(osg::StateAttribute::LIGHT, number));
}

} // namespace

TEST(SurfaceState, resolvesRandomPathsAsOsgStateDoes)
{
    std::mt19937 random(21);
    for (int path = 0; path < 3000; ++path)
    {
        osg::ref_ptr<TopOfState> real = new TopOfState;
        SurfaceState state;
        std::vector<osg::ref_ptr<osg::StateSet>> stateSets(1 + random() % 7);
        for (osg::ref_ptr<osg::StateSet>& stateSet : stateSets)
        {
            stateSet = randomStateSet(random);
            real->pushStateSet(stateSet);
            state.apply(*stateSet);
            ASSERT_NO_FATAL_FAILURE(expectSame(state, *real)) << "path " << path;
        }
    }
}

TEST(SurfaceState, aCopyGoesItsOwnWay)
{
    osg::ref_ptr<osg::StateSet> parent = new osg::StateSet, child = new osg::StateSet;
    parent->setMode(GL_LIGHT0 + 12, On);
    child->setMode(GL_LIGHT0 + 12, Off);
    child->setMode(GL_LIGHT0 + 40, On);
    SurfaceState above;
    above.apply(*parent);
    SurfaceState below = above;
    EXPECT_EQ(above.getExtraLightsIdentity(), below.getExtraLightsIdentity());
    below.apply(*child);
    EXPECT_TRUE(above.isLightOn(12));
    EXPECT_FALSE(above.isLightOn(40));
    EXPECT_FALSE(below.isLightOn(12));
    EXPECT_EQ(below.getExtraLights(), std::vector<unsigned int>{40});
    EXPECT_EQ(below.getExtraLights(false), (std::vector<unsigned int>{12, 40}));
}

TEST(SurfaceState, overrideHoldsUntilProtectedBreaksIt)
{
    osg::ref_ptr<osg::StateSet> top = new osg::StateSet, middle = new osg::StateSet,
                                bottom = new osg::StateSet;
    top->setMode(GL_LIGHTING, Off | Override);
    middle->setMode(GL_LIGHTING, On);
    bottom->setMode(GL_LIGHTING, On | Protected);
    SurfaceState state;
    state.apply(*top);
    state.apply(*middle);
    EXPECT_FALSE(state.isOn(SurfaceState::Lighting));
    state.apply(*bottom);
    EXPECT_TRUE(state.isOn(SurfaceState::Lighting));
}
