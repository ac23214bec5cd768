// SPDX-License-Identifier: MIT
// A MixedScene's part in the draw of one view of one frame. Not installed.
#pragma once

#include <osgMultiRender/MixDraw.h>
#include <osgMultiRender/MixLights.h>
#include <osgMultiRender/SurfaceGroup.h>

#include <set>

namespace osgMultiRender
{

class MixPass : public SurfacePass
{
public:
    /// `toScene` leads from the key points to the coordinates of the scene.
    MixPass(std::shared_ptr<MixResources> resources, std::shared_ptr<const MixSnapshot> snapshot,
            const osg::Matrixd& toScene);

    SurfaceRole getRole() const override { return SurfaceRole::Surface; }
    void cull(osgUtil::CullVisitor& visitor, SurfaceGroup& group,
              const osg::StateSet* scope) override;
    void begin(osg::RenderInfo& renderInfo, const SurfaceFrame& frame) override;
    void classify(const SurfaceState&, const osgUtil::RenderLeaf&, bool, SurfaceKey&,
                  std::uint32_t&) override
    {
    }
    SurfaceLook* look(const SurfaceState& state, const osgUtil::RenderLeaf& leaf) override;
    void end(osg::RenderInfo& renderInfo) override;
    void drawn(osg::RenderInfo& renderInfo) override;
    SurfaceSnippet makeSnippet(const SurfaceKey&) const override { return {}; }
    const osg::StateSet* startRun() override;
    void apply(osg::RenderInfo& renderInfo, const SurfaceVariant& variant,
               const osgUtil::RenderLeaf& leaf, std::uint32_t number) override;
    void fillPlan(Plan& plan) const override;

private:
    struct Shown
    {
        osg::ref_ptr<MixProgram> program; ///< Of this set; null: there is none yet.
        unsigned int leaves = 0;
    };

    void startVariant(osg::State& state, const SurfaceVariant& variant,
                      const osg::Viewport& viewport);
    MixBox boxOf(const osgUtil::RenderLeaf& leaf, double& margin) const;
    std::vector<MixPart> partsOf(const SurfaceFrame& frame) const;
    MixSet setOf(const osgUtil::RenderLeaf& leaf) const;
    int lightsOf(const SurfaceState& state, const MixSet& set) const;
    std::string nameOf(const MixSet& set) const;

    MixDraw _draw;
    const osg::Matrixd _keysToScene;
    osg::Matrixd _keysToEye, _eyeToKeys;
    bool _isCulled = false;
    std::map<MixSet, Shown> _sets;
    /// Of the renderings' uniforms. Looks, not their texts: two may differ in values alone.
    std::map<const SurfaceLook*, std::shared_ptr<const MixProgram::Values>> _values;
    std::set<const SurfaceVariant*> _sent;    ///< Have their values in this run.
    const osg::Viewport* _viewport = nullptr; ///< As the program has it.
    const SurfaceVariant* _variant = nullptr;
    MixLights _lights; ///< Of that variant's program.
};

} // namespace osgMultiRender
