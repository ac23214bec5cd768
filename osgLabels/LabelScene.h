// SPDX-License-Identifier: MIT
#pragma once

#include <osgLabels/Export.h>
#include <osgLabels/LabelPick.h>
#include <osgLabels/LabelSettings.h>

#include <osgMultiRender/SurfaceGroup.h>

#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

namespace osgLabels
{

class LabelResources;

/// A scene with text on the surfaces of its objects.
///
/// Each named object carries its name: one draw writes colour, object and distance, a
/// pass over the screen then puts glyphs there, so that the cost hardly depends on the number of
/// labels. Nothing of the model is changed but
/// the identifiers of PrimitiveBatches. Opaque surfaces in bins sorted by state go that way,
/// see SurfaceState::isCopyable(); others get their label while they are drawn, in a bin sorted by
/// state after those. Points carry none. Where nothing labelled is in
/// view leaves are drawn as without the group. Prado, Raposo, Real-Time Label Visualization in
/// Massive CAD Models, 2013. Requires GL 3.3 compatibility.
class OSGLABELS_EXPORT LabelScene : public osgMultiRender::SurfaceGroup
{
public:
    LabelScene();
    LabelScene(const LabelScene& other, const osg::CopyOp& copyop = osg::CopyOp::SHALLOW_COPY);
    META_Node(osgLabels, LabelScene)

    /// Changes the text of an object while the scene is shown, from any thread; the next frame
    /// shows it. UTF-8; an empty text is none. False for an identifier that no object has.
    bool setText(std::uint32_t identifier, const std::string& text);

    /// UTF-8; not while another thread changes the subgraph.
    std::string getText(std::uint32_t identifier) const;

    /// Changes its style, likewise, to one of those that the settings name; LabelStyle::DefaultName
    /// is that of all others. False for an identifier that no object has and, with a warning, for
    /// a style that is not there.
    bool setStyle(std::uint32_t identifier, const std::string& name);
    std::string getStyle(std::uint32_t identifier) const;

    /// What is at a point of a picture.
    struct Picked
    {
        std::uint32_t identifier = 0; ///< 0: nothing labelled.
        std::string text;
        std::string path; ///< Names of the nodes from this one down, "/scene/pump/P-101".
    };
    /// Asks the next picture of the scene that a view shows, or the camera's own: one in the scene
    /// that renders to a texture answers only where it is named. `x` and `y` from -1 to 1 from the
    /// lower left corner of the picture. Opaque surfaces count.
    void pick(double x, double y, const osg::Camera* camera = nullptr,
              PickAsker asker = PickAsker::Application);
    /// The answer to the last pick() of the asker, once; none before it is there. Not while another
    /// thread changes the subgraph.
    std::optional<Picked> takePicked(PickAsker asker = PickAsker::Application);

    /// Whether labels are drawn.
    void setShown(bool shown) { _isShown = shown; }
    bool isShown() const { return _isShown; }

    /// Counts from the next traversal on; not while one runs. Labels are collected anew.
    void setSettings(const LabelSettings& settings);
    const LabelSettings& getSettings() const { return _settings; }
    /// As text, "size='0.3',ink='#ff0000'": all that differ from the defaults.
    /// What is unknown or wrong in it is named in a warning and does not count. Files hold this
    /// text and isShown(); what setText() and setStyle() have changed they do not hold, since
    /// texts and styles come from the objects.
    void setSettingsText(const std::string& text);
    std::string getSettingsText() const;

    void traverse(osg::NodeVisitor& visitor) override;
    void releaseGLObjects(osg::State* state = nullptr) const override;

    /// What views share; null before the first cull traversal.
    std::shared_ptr<LabelResources> getResources() const;

protected:
    ~LabelScene() override;

    void cullSubgraph(osg::NodeVisitor& visitor) override;
    std::unique_ptr<osgMultiRender::SurfacePass> createPass() const override;

private:
    void collect();

    LabelSettings _settings;
    bool _isShown = true;
    mutable std::mutex _mutex;
    std::shared_ptr<LabelResources> _resources;
    const std::shared_ptr<LabelPicks> _picks = std::make_shared<LabelPicks>();
};

} // namespace osgLabels
