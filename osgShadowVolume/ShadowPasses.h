// SPDX-License-Identifier: MIT
#pragma once

#include <osg/State>
#include <osg/StateSet>

#include <map>
#include <mutex>
#include <string>

namespace osgShadowVolume
{

/// The states in which shadow volumes, depths and masks are drawn. Thread safe.
class ShadowPasses
{
public:
    enum class Pass
    {
        Depth,   ///< Opaque receivers.
        Masked,  ///< Opaque receivers with alpha test: their own program draws.
        Peel,    ///< Transparent receivers.
        Clear,   ///< Full screen: no light is taken away.
        Resolve, ///< Full screen: counts become a bit.
        TessSides,
        GeometrySides,
        GeometryCaps,
        TriangleSides, ///< Found on the CPU, as the caps below.
        TriangleCaps
    };

    /// What a context can do, and what a view needs.
    struct Tier
    {
        int language = 330; ///< GLSL version, times 100.
        int samples = 1;
        bool operator<(const Tier& other) const
        {
            return language != other.language ? language < other.language : samples < other.samples;
        }
    };

    /// How volumes are drawn.
    enum class Count
    {
        ZPass, ///< What is before the depths.
        ZFail, ///< What is behind them.
        Shown  ///< As translucent surfaces in the picture.
    };

    /// The state of a pass; `count` is for the volumes alone. Lives as long as this.
    const osg::StateSet& get(Pass pass, const Tier& tier, Count count = Count::ZPass);
    /// Of a pass that draws receivers, for those that a VertexSnippet with this GLSL places; null
    /// for all others.
    const osg::StateSet& getFor(Pass pass, const Tier& tier, const std::string* instance);

    void releaseGLObjects(osg::State* state) const;

private:
    struct Key
    {
        Pass pass;
        Tier tier;
        Count count;
        std::string instance; ///< GLSL; empty for none.
        bool operator<(const Key& other) const
        {
            if (instance != other.instance)
                return instance < other.instance;
            if (pass != other.pass)
                return pass < other.pass;
            return count != other.count ? count < other.count : tier < other.tier;
        }
    };
    const osg::StateSet& get(const Key& key);
    osg::ref_ptr<osg::StateSet> make(const Key& key);
    osg::ref_ptr<osg::Program> makeProgram(const Key& key);

    mutable std::mutex _mutex;
    std::map<Key, osg::ref_ptr<osg::StateSet>> _states;
};

} // namespace osgShadowVolume
