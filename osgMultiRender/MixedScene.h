// SPDX-License-Identifier: MIT
#pragma once

#include <osgMultiRender/KeyPoints.h>
#include <osgMultiRender/Merger.h>
#include <osgMultiRender/MixWeights.h>
#include <osgMultiRender/Rendering.h>
#include <osgMultiRender/SurfaceGroup.h>

#include <osg/Vec3d>

#include <memory>
#include <string>
#include <vector>

namespace osgMultiRender
{

class MixDrag;
class MixWatch;
struct MixResources;
struct MixSlot;
struct MixSnapshot;

/// What is drawn of the key points beside the scene.
enum class MixMarks
{
    Off,
    Points, ///< Red spheres.
    Lines   ///< These, and what joins them.
};

/// What the renderings are shown on.
enum class MixInput
{
    Surface, ///< The surfaces of the subgraph, instead of their own look.
    Frame    ///< The frame, when all of it is drawn: for renderings of images.
};

/// Shows its subgraph as a mix of renderings, weighted by the distance to key points.
///
/// Any number of complete GPU programs, built-in or imported, become one program; what a surface
/// shows is the sum of their colours times their weights. Key points, ranges, rules and uniforms
/// change at run time without compiling anything. When renderings are added, changed or removed
/// the program is merged anew in a thread of its own, and the one before stays until the new one is
/// linked; a rendering that can't be used is left out, with one warning that names its own file and
/// line. Drawables that need fewer renderings get a program of these. Nothing of the model is
/// changed; surfaces of PrimitiveBatches and with a PROTECTED program keep their own look.
///
/// All setters may be called from any thread; they count from the next cull traversal on. Where all
/// renderings fail the model's own look shows. Requires OpenGL 3.3 (compatibility).
class OSGMULTIRENDER_EXPORT MixedScene : public SurfaceGroup
{
public:
    MixedScene();
    MixedScene(const MixedScene& other, const osg::CopyOp& copyop = osg::CopyOp::SHALLOW_COPY);
    META_Node(osgMultiRender, MixedScene)

    /// The most renderings of a scene; how many a program can hold the context decides.
    static constexpr unsigned int MaxRenderings = 1024;
    static constexpr unsigned int None = ~0u;

    /// Returns the number by which the rendering is known until it is removed: the lowest that is
    /// free. None, with a warning, if there are MaxRenderings.
    unsigned int addRendering(const Rendering& rendering, const MixRange& range = MixRange());
    /// Puts another one in its place, which keeps range and values of uniforms: the one before
    /// stays on screen until the new one is linked, and where that can't be used. False for a
    /// number that none has; so below.
    bool setRendering(unsigned int number, const Rendering& rendering);
    bool removeRendering(unsigned int number);
    /// Those that are there, in order.
    std::vector<unsigned int> getRenderings() const;
    /// Null for a number that none has.
    std::shared_ptr<const Rendering> getRendering(unsigned int number) const;

    bool setRange(unsigned int number, const MixRange& range);
    MixRange getRange(unsigned int number) const;

    /// In coordinates of this node, or of the one that they are attached to.
    void setKeyPoints(const std::vector<osg::Vec3d>& points, KeyMode mode = KeyMode::Points);
    std::vector<osg::Vec3d> getKeyPoints() const;
    KeyMode getKeyMode() const;
    /// Key points move with the node, which is found anew in each frame by its first path; null:
    /// with this one.
    void setKeyNode(osg::Node* node);
    const osg::Node* getKeyNode() const;

    /// `rules.base` is the number of a rendering or -1.
    void setRules(const MixRules& rules);
    MixRules getRules() const;
    /// Whether what is missing to a sum of 1 shows what was drawn behind, instead of the background
    /// of the rules: surfaces are blended in the order in which they are drawn.
    void setTransparent(bool transparent);
    bool isTransparent() const;
    /// Whether imports whose description holds lights and materials, as projects of ShaderDesigner
    /// do, read these instead of the scene's; lights are then fixed to the eye. Off by default, so
    /// that one scene is lit by one light.
    void setOwnLighting(bool own);
    bool getOwnLighting() const;

    /// With Frame surfaces keep their own look, or that of MixedScenes below. When the view has
    /// been drawn, a second pass replaces each pixel of the viewport by the mix of what renderings
    /// make of the picture, which they read as the model's texture on unit 0; distances are those
    /// of the surface in the pixel, from the depth buffer. Where nothing was drawn there is no
    /// distance: what has an infinite dr3 counts there. Several samples become one. Not for targets
    /// without depth or of several colour buffers: they keep their picture, with a warning.
    void setInput(MixInput input);
    MixInput getInput() const;

    /// Sets a uniform of a rendering, by the name that its author gave it: all components of all
    /// elements, 0 and 1 for bool. Those of samplers, blocks and OSG (`osg_`) are not taken.
    bool setUniform(unsigned int number, const std::string& name,
                    const std::vector<double>& values);
    /// As set, else as the rendering has it; empty where neither says anything.
    std::vector<double> getUniform(unsigned int number, const std::string& name) const;

    /// The names of those that have been set; empty for a number that none has.
    std::vector<std::string> getSetUniforms(unsigned int number) const;

    /// Whether drawables get programs of only those renderings that they need.
    void setPruning(bool prunes);
    bool getPruning() const;
    /// Such programs are made when points, ranges and rules have not changed for so many frames, so
    /// that no movement compiles anything. 0: at once, in the frame that wants them first.
    void setSettleFrames(unsigned int frames);
    unsigned int getSettleFrames() const;
    /// So many are kept, at least; those of the frame beyond that.
    void setMaxPrograms(unsigned int programs);
    unsigned int getMaxPrograms() const;
    /// Limits of programs below those of the context: for what an application has of its own, or
    /// for tests. They count what renderings take, key points not included. Where one is passed the
    /// rendering with the least weight in the picture that counts for it is left out; the plan and
    /// a warning name both. When nothing moves and another one has the least weight, they change
    /// places. Null: only those of the context. No part of the mix's text.
    void setLimits(const MergeLimits* limits);

    void setMarks(MixMarks marks);
    MixMarks getMarks() const;
    /// Whether the scene answers to mixKeys(), and to the mouse: with Ctrl and the left button a
    /// marker is dragged, with Shift a click takes it away or makes a new one on a surface.
    void setAnswersKeys(bool answers);
    bool getAnswersKeys() const;

    /// Everything but the subgraph as text, JSON as in mix files. What is wrong in it is named in a
    /// warning, and then nothing counts.
    void setMixText(const std::string& text);
    std::string getMixText() const;

    /// Whether files are looked after once a second, in a thread of its own: those of renderings,
    /// their textures and the mix file. What has changed is imported anew, as setRendering() does
    /// it; a mix file's renderings, points and settings take the place of all that are there. A
    /// file with errors leaves what is shown, with one warning that names it.
    void setWatching(bool watches);
    bool isWatching() const;
    /// The mix file that is looked after; "" for none. readMixFile() sets it.
    void setMixFile(const std::string& fileName);
    std::string getMixFile() const;
    /// Reads all these files again, changed or not.
    void readFilesAgain();

    /// All settings, without the subgraph.
    osg::ref_ptr<MixedScene> cloneSettings() const;
    /// Takes all settings of another one at once; whether files are looked after stays.
    void takeSettings(const MixedScene& other);

    /// The text of the program that shows all renderings, both stages; empty before it was drawn.
    std::string getSource() const;

    std::vector<Plan> getPlans() const override;

    void traverse(osg::NodeVisitor& visitor) override;
    void resizeGLObjectBuffers(unsigned int maxSize) override;
    void releaseGLObjects(osg::State* state = nullptr) const override;

protected:
    ~MixedScene() override;

    std::unique_ptr<SurfacePass> createPass() const override;

private:
    template <class Change> void change(Change change);
    template <class Change> bool changeSlot(unsigned int number, Change change);
    std::shared_ptr<const MixSnapshot> getSnapshot() const;
    std::shared_ptr<const MixSlot> beforeOf(const MixSlot& slot) const;
    osg::Matrixd keysToScene() const;
    osg::ref_ptr<osg::Node> makeMarks();
    void reimport(const std::vector<std::string>& files, bool all);
    std::vector<std::string> getWatchedFiles() const;
    void cullFrame(osg::NodeVisitor& visitor);
    std::shared_ptr<MixResources> getResources() const;

    mutable std::mutex _settings;
    std::shared_ptr<const MixSnapshot> _snapshot;
    std::vector<osg::Vec3d> _points;
    osg::observer_ptr<osg::Node> _keyNode;
    MixMarks _marks = MixMarks::Off;
    bool _answersKeys = true;
    osg::ref_ptr<osg::Node> _drawnMarks; ///< Of these key points; null: to be made.
    float _markSize = 0.0f;
    std::shared_ptr<MixResources> _resources; ///< Another one when the input changes.
    std::unique_ptr<MixDrag> _drag;           ///< Of the thread of events.
    std::string _mixFile;
    mutable std::mutex _watching;
    std::unique_ptr<MixWatch> _watch;        ///< Null: files are not looked after.
    osg::ref_ptr<osg::StateSet> _frameState; ///< Null before the first pass over a frame.
};

} // namespace osgMultiRender
