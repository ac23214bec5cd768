// SPDX-License-Identifier: MIT
// A VirtualScene's part in the draw of one view of one frame. Not installed.
#pragma once

#include <osgPagedTexture/VirtualResources.h>

#include <osgMultiRender/SurfaceFrame.h>

#include <array>
#include <set>

namespace osgPagedTexture
{

class VirtualPass : public osgMultiRender::SurfacePass
{
public:
    explicit VirtualPass(std::shared_ptr<VirtualResources> resources);

    osgMultiRender::SurfaceRole getRole() const override
    {
        return osgMultiRender::SurfaceRole::Texture;
    }
    void begin(osg::RenderInfo& renderInfo, const osgMultiRender::SurfaceFrame& frame) override;
    void classify(const osgMultiRender::SurfaceState& state, const osgUtil::RenderLeaf& leaf,
                  bool ordered, osgMultiRender::SurfaceKey& key, std::uint32_t& number) override;
    void end(osg::RenderInfo&) override {}
    void drawBefore(osg::RenderInfo& renderInfo, osgMultiRender::SurfaceFrame& frame) override;
    osgMultiRender::SurfaceSnippet
    makeSnippet(const osgMultiRender::SurfaceKey& key) const override;
    const osg::StateSet* startRun() override;
    void apply(osg::RenderInfo& renderInfo, const osgMultiRender::SurfaceVariant& variant,
               const osgUtil::RenderLeaf& leaf, std::uint32_t number) override;
    void fillPlan(osgMultiRender::Plan& plan) const override;

private:
    static constexpr unsigned int Units = osgMultiRender::SurfaceState::MaxTextureUnits;
    /// Bits of SurfaceKey::texture.
    enum Bits : std::uint32_t
    {
        Sampled = 0xf,      ///< One a unit.
        Feedback = 1u << 4, ///< Needs of pages are drawn.
        Cutout = 1u << 5,   ///< Of feedback: what is transparent hides nothing.
        Sheer = 1u << 6,    ///< Of feedback: every other pixel hides what is behind.
        Taps = 1u << 7,     ///< Several along a footprint.
        Wraps = 1u << 8,    ///< Coordinates beyond 0 to 1 repeat or mirror.
        Fades = 1u << 9,    ///< New pages fade in.
        Shows = 1u << 10    ///< Levels or borders of pages.
    };
    /// How a unit is sampled.
    struct Code
    {
        int number = -1;  ///< With the pager, and the table's row; -1: not by us.
        int sampling = 0; ///< Taps and wrap modes as in virtual.glsl.
    };
    using Codes = std::array<Code, Units>;

    Code codeOf(const VirtualTexture& texture);
    std::uint32_t featuresOf(const Code& code) const;
    void sendFrame(osg::State& state) const;
    bool rekey(const osgMultiRender::SurfaceItem& item, osgMultiRender::SurfaceKey& key) const;
    void drawFeedback(osg::RenderInfo& renderInfo, osgMultiRender::SurfaceFrame& frame,
                      VirtualContext::View& view, unsigned int reduction, unsigned int number);
    unsigned int wholePictures() const;
    std::uint64_t hashOf(osgMultiRender::SurfaceFrame& frame) const;
    void waitForPages(osg::RenderInfo& renderInfo, osgMultiRender::SurfaceFrame& frame,
                      VirtualContext::View& view);
    void goOn(osg::RenderInfo& renderInfo, osgMultiRender::SurfaceFrame& frame,
              VirtualContext::View& view);

    const std::shared_ptr<VirtualResources> _resources;
    const VirtualSettings _settings;
    const osgMultiRender::SurfaceFrame* _frame = nullptr;
    osg::ref_ptr<VirtualContext> _context; ///< Null where nothing can be shown.
    unsigned int _frameNumber = 0;
    double _seconds = 0.0;
    bool _isFeedback = false;  ///< What is drawn now.
    std::vector<Codes> _codes; ///< By the numbers of leaves.
    std::map<std::array<const VirtualTexture*, Units>, std::uint32_t> _numbers;
    std::map<const VirtualTexture*, Code> _codeOf;
    std::set<const osgMultiRender::SurfaceVariant*> _sent; ///< Have what holds for all leaves.
    bool _hasFeedback = false;
};

} // namespace osgPagedTexture
