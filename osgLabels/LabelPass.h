// SPDX-License-Identifier: MIT
#pragma once

#include <osgLabels/LabelPick.h>
#include <osgLabels/LabelResources.h>
#include <osgLabels/LabelSettings.h>
#include <osgLabels/LabelTargets.h>

#include <osgMultiRender/SurfaceFrame.h>

#include <osg/Matrixd>
#include <osg/Viewport>

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <tuple>
#include <unordered_map>

namespace osgLabels
{

class MapPass;

/// Bits of SurfaceKey::output.
enum OutputBits : std::uint32_t
{
    Diverted = 1,      ///< Writes the targets of the first pass.
    Labelled = 2,      ///< Has an object record.
    IndexUniform = 4,  ///< The record's index is a uniform, not an attribute.
    Paged = 8,         ///< Buffers are 2D arrays.
    Proportional = 32, ///< Letters have widths of their own.
    Outlined = 64,     ///< Letters have outlines.
    Textured = 128,    ///< The targets have texture coordinates.
    // 12 to 15 are those of MapBits.
    TexCoords = 16, ///< Texture coordinates may place the text: of the unit from bit 8.
    UnitShift = 8
};

/// Writes objects and distances beside the colours, then the glyphs, for one view of one frame.
class LabelPass : public osgMultiRender::SurfacePass
{
public:
    /// Without resources labels are not shown.
    LabelPass(std::shared_ptr<LabelResources> resources, std::shared_ptr<LabelPicks> picks,
              const LabelSettings& settings);
    ~LabelPass() override;

    osgMultiRender::SurfaceRole getRole() const override
    {
        return osgMultiRender::SurfaceRole::Output;
    }
    void cull(osgUtil::CullVisitor& visitor, osgMultiRender::SurfaceGroup& group,
              const osg::StateSet* scope) override;
    void begin(osg::RenderInfo& renderInfo, const osgMultiRender::SurfaceFrame& frame) override;
    void classify(const osgMultiRender::SurfaceState& state, const osgUtil::RenderLeaf& leaf,
                  bool ordered, osgMultiRender::SurfaceKey& key, std::uint32_t& number) override;
    void end(osg::RenderInfo& renderInfo) override;
    void drawBefore(osg::RenderInfo& renderInfo, osgMultiRender::SurfaceFrame& frame) override;
    bool diverts(const osgMultiRender::SurfaceItem& item) const override;
    void divert(osg::RenderInfo& renderInfo, const std::function<void()>& draw) override;
    void drawn(osg::RenderInfo& renderInfo) override;
    osgMultiRender::SurfaceSnippet
    makeSnippet(const osgMultiRender::SurfaceKey& key) const override;
    const osg::StateSet* startRun() override;
    void apply(osg::RenderInfo& renderInfo, const osgMultiRender::SurfaceVariant& variant,
               const osgUtil::RenderLeaf& leaf, std::uint32_t number) override;
    void fillPlan(osgMultiRender::Plan& plan) const override;

    /// Declares osgLabels_index, the record of the object that a fragment is of.
    static void addIndex(const osgMultiRender::SurfaceKey& key,
                         osgMultiRender::SurfaceSnippet& snippet);

private:
    /// osgLabels_Frame of locate.glsl, and one float more to fill seven texels.
    using Frame = std::array<float, 28>;
    /// Of an object's record: what the vertex attribute has, and what is added.
    struct Index
    {
        GLint object, base;
    };
    struct Applied
    {
        const osg::RefMatrix* modelview = nullptr;
        const osg::RefMatrix* projection = nullptr;
        const osg::Matrixd* scale = nullptr;
        const osg::Viewport* viewport = nullptr;
        GLint recordBase = 0;
        bool isSet = false;
    };

    void addTexCoords(const osgMultiRender::SurfaceKey& key,
                      osgMultiRender::SurfaceSnippet& snippet) const;
    void addLabel(const osgMultiRender::SurfaceKey& key,
                  osgMultiRender::SurfaceSnippet& snippet) const;
    static Index indexOf(const osgUtil::RenderLeaf& leaf, std::uint32_t number);
    /// See UnevenScales; null for none.
    const osg::Matrixd* scaleOf(const osgUtil::RenderLeaf& leaf) const;
    Frame frameOf(const osgUtil::RenderLeaf& leaf) const;
    /// Of the leaf's frame among those of this view; negative where rays are parallel.
    int numberOf(const osgUtil::RenderLeaf& leaf);
    /// Whether the leaf is drawn into the viewport of the view, not into one of its own.
    bool isInView(const osgMultiRender::SurfaceState& state) const;
    void setViewport(const osg::GLExtensions& gl, const osg::Program::PerContextProgram& program,
                     const osg::Viewport* viewport) const;
    void clear(osg::State& state) const;
    void findObjects(osgUtil::CullVisitor& visitor, osgMultiRender::SurfaceGroup& group,
                     const std::vector<const osgUtil::RenderLeaf*>& leaves);
    void addNumber(const osgUtil::RenderLeaf& leaf, std::uint32_t number);
    void takeQuestions(osgUtil::CullVisitor& visitor);
    void answer();
    void readPicked(osg::State& state);
    /// Why OpenGL can't draw into the targets, said once on the console; empty where it can.
    std::string whyIncomplete(osg::State& state);
    void composite(osg::RenderInfo& renderInfo);
    void makeUnder(osg::State& state);

    const std::shared_ptr<LabelResources> _resources;
    const std::shared_ptr<LabelPicks> _picks;
    std::string _reason; ///< Why no surface has a label in this view; empty where some have.
    std::unique_ptr<MapPass> _map; ///< Null where the scene has no map labels.
    unsigned int _contextID = 0;
    float _languageVersion = 3.3f;
    bool _isPaged = false;
    GLint _viewport[4] = {};
    osgMultiRender::DrawTarget _target;
    osg::Vec3d _up; ///< Of the world, in eye coordinates.
    FramesInFlight::Ticket _ticket;
    /// Labelled leaves in view: the index of their record; of a batch's run what is added to that
    /// of an object in its page; of a chunk that of the first object.
    std::unordered_map<const osgUtil::RenderLeaf*, std::uint32_t> _objects;
    std::unordered_map<const osgUtil::RenderLeaf*, std::shared_ptr<const osg::Matrixd>>
        _scales; ///< Of few.
    unsigned int _direct = 0, _passes = 0;
    std::vector<Frame> _frames;
    std::map<std::tuple<const osg::RefMatrix*, const osg::RefMatrix*, const osg::Matrixd*>, int>
        _frameNumbers;
    /// What this picture is asked, by PickAsker, and what lies there, as far as is drawn.
    struct Asked
    {
        std::optional<LabelPick::Question> question;
        std::uint32_t identifier = 0;
    };
    std::array<Asked, LabelPicks::Askers> _asked;
    osg::ref_ptr<LabelTargets> _targets;
    osg::ref_ptr<osg::StateSet> _under;
    std::unordered_map<const osgMultiRender::SurfaceVariant*, Applied> _applied;
};

} // namespace osgLabels
