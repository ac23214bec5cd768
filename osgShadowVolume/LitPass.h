// SPDX-License-Identifier: MIT
#pragma once

#include <osgShadowVolume/IlluminanceView.h>
#include <osgShadowVolume/LightGrid.h>
#include <osgShadowVolume/LightShadows.h>
#include <osgShadowVolume/LightTextures.h>
#include <osgShadowVolume/Mirrors.h>

#include <osgMultiRender/SurfaceFrame.h>

#include <map>
#include <optional>

namespace osgShadowVolume
{

/// Lights the leaves of a LitScene in one view of one frame.
///
/// Each leaf gets the list of the lights that reach it, as uniforms where they are few; where a
/// state has many lights, its leaves share a grid instead. What is left out adds less than half a
/// step of 8 bits to any pixel.
class LitPass : public osgMultiRender::SurfacePass
{
public:
    explicit LitPass(const LitScene& scene);
    /// `shadows` may be null.
    LitPass(const LitScene& scene, const ShadowSettings& settings,
            std::unique_ptr<LightShadows> shadows);

    /// What to measure with, for Show::LUX and Show::ILLUMINANCE. To be set before cull().
    void setIlluminance(IlluminanceView* illuminance) { _illuminance = illuminance; }

    /// What reflects. To be set before cull().
    void setMirrors(std::unique_ptr<Mirrors> mirrors) { _mirrors = std::move(mirrors); }

    void cull(osgUtil::CullVisitor& visitor, osgMultiRender::SurfaceGroup& group,
              const osg::StateSet* scope) override;
    bool isDynamic() const override;

    osgMultiRender::LightingMode getLighting() const override;
    void begin(osg::RenderInfo& renderInfo, const osgMultiRender::SurfaceFrame& frame) override;
    void classify(const osgMultiRender::SurfaceState& state, const osgUtil::RenderLeaf& leaf,
                  bool ordered, osgMultiRender::SurfaceKey& key, std::uint32_t& number) override;
    bool classifiesUnlit() const override;
    void end(osg::RenderInfo& renderInfo) override;
    void drawBefore(osg::RenderInfo& renderInfo, osgMultiRender::SurfaceFrame& frame) override;
    void drawn(osg::RenderInfo& renderInfo) override;
    osgMultiRender::SurfaceSnippet
    makeSnippet(const osgMultiRender::SurfaceKey& key) const override;
    const osg::StateSet* startRun() override;
    void apply(osg::RenderInfo& renderInfo, const osgMultiRender::SurfaceVariant& variant,
               const osgUtil::RenderLeaf& leaf, std::uint32_t number) override;
    void fillPlan(osgMultiRender::Plan& plan) const override;

private:
    /// The lights that a state switches on.
    struct LightSet
    {
        std::vector<std::uint32_t> lights; ///< Indices into _lights.
        std::vector<double> reach;         ///< Parallel to _lights.
        std::optional<LightGrid> grid;     ///< Only for more than MaxListed lights.
        std::uint32_t gridNumber = 0;      ///< Of _lists, when there is a grid.
        bool reachesAll = false;           ///< Each light reaches everything: leaves need no test.
        struct ForAll
        {
            std::uint32_t kit, number;
        };
        std::optional<ForAll> forAll; ///< What classify() then gives to every leaf.
    };
    /// What apply() sets for a leaf.
    struct List
    {
        std::vector<std::uint32_t> lights;
        int offset = 0;
        std::vector<float> uniforms; ///< The lights themselves, where they are few.
        const LightSet* grid = nullptr;
        int gridCells = 0;
    };
    /// What apply() gets as the number of a leaf with the kit bit Reflecting.
    struct Reflection
    {
        std::uint32_t list; ///< Of _lists, where the leaf has lights.
        int mirror;
    };
    struct Dropped
    {
        EyeLight light;
        std::string reason;
    };

    /// False, and the light is listed as dropped, where nothing can be computed with it.
    bool isUsable(const EyeLight& light);
    LightSet& setOf(const osgMultiRender::SurfaceState& state);
    void chooseGridAxes(const osgMultiRender::SurfaceFrame& frame);
    glm::dvec3 toGrid(const glm::dvec3& eye) const;
    glm::dvec3 fromGrid(const glm::dvec3& grid) const;
    std::vector<EyeLight> collectLights(const osgMultiRender::SurfaceFrame& frame);
    /// Vertex lighting: the lights that GL has.
    void leaveToGL(const std::vector<EyeLight>& all);
    /// Sets the box of what is in view; true if it is finite and holds everything.
    bool measureBox(const osgMultiRender::SurfaceFrame& frame);
    /// Fills the list of lights with those that reach something in view; returns their reaches.
    std::vector<double> keepReaching(const std::vector<EyeLight>& all, bool everythingBounded);
    void planShadows(osg::RenderInfo& renderInfo, bool everythingBounded,
                     const std::vector<double>& limits);
    void choosePoints();
    void fillReach(LightSet& set) const;
    void makeGrid(LightSet& set);
    std::uint32_t listOf(std::vector<std::uint32_t> lights);
    bool isUniform(const List& list) const;
    bool hasShadow(const List& list) const;
    /// Whether light counts for surfaces that the model does not light, too.
    bool lightsUnlit() const;
    void addMirrorBit(const osgMultiRender::SurfaceState& state, const osgUtil::RenderLeaf& leaf,
                      osgMultiRender::SurfaceKey& key, std::uint32_t& number);
    void classifyLights(const osgMultiRender::SurfaceState& state, const osgUtil::RenderLeaf& leaf,
                        osgMultiRender::SurfaceKey& key, std::uint32_t& number);
    void addShadowBits(const osgMultiRender::SurfaceState& state, const osgUtil::RenderLeaf& leaf,
                       osgMultiRender::SurfaceKey& key, std::uint32_t number) const;
    float shadowIndexOf(std::size_t light) const;
    /// Fills in what the light gives off; false for one that is not measured.
    bool measure(EyeLight& eye, const osg::Light& light, const osgMultiRender::SurfaceFrame& frame);
    double reachOf(const EyeLight& light, double threshold) const;
    const osg::StateSet* mergeUnder(std::initializer_list<const osg::StateSet*> stateSets);

    const LitScene& _scene;
    const LitScene::Lighting _lighting;     ///< Of the cull; the update may change the scene's.
    const LitScene::LightScope _lightScope; ///< Likewise.
    const double _tolerance;
    const ShadowSettings _settings;
    std::unique_ptr<LightShadows> _shadows;  ///< Null where nothing casts.
    std::unique_ptr<Mirrors> _mirrors;       ///< Null where nothing reflects.
    IlluminanceView* _illuminance = nullptr; ///< The scene's.
    LightMeasures _measures;
    std::vector<EyeLight> _lights;
    std::vector<bool> _used;
    std::vector<Dropped> _dropped;
    std::vector<glm::dvec3> _points; ///< Samples of what is in view.
    /// From eye coordinates to axes along those of the world, where floors and walls are flat, so
    /// that a grid spends no cells on a tilted box's empty corners. A rotation; the origin is the
    /// eye.
    osg::Matrixd _toGrid;
    glm::dvec3 _boxMin{0.0}, _boxMax{0.0}; ///< Of what is in view, along these axes.
    bool _hasBox = false; ///< The box is finite; leaves without a bound are not in it.
    unsigned int _grids = 0;
    std::map<std::pair<std::uint32_t, const void*>, LightSet> _sets;
    std::map<std::vector<std::uint32_t>, std::uint32_t> _listNumbers;
    std::vector<List> _lists;
    std::vector<Reflection> _reflections;
    std::vector<const EyeLight*> _gpuLights; ///< What the textures hold.
    std::vector<float> _gpuShadows;          ///< Parallel: indices of shadows.
    std::vector<std::int32_t> _gpuLists;     ///< Likewise.
    /// The list that each program's uniforms hold during a run.
    std::map<const osgMultiRender::SurfaceVariant*, std::uint32_t> _applied;
    osg::ref_ptr<osg::StateSet> _under; ///< Textures of lights and shadows, where there are both.
    osg::ref_ptr<LitScene::LightTextures::Context> _textures; ///< Null while no leaf needs a light.
};

} // namespace osgShadowVolume
