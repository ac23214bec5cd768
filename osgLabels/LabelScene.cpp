// SPDX-License-Identifier: MIT
#include <osgLabels/LabelScene.h>

#include <osgLabels/LabelPass.h>
#include <osgLabels/LabelResources.h>

namespace osgLabels
{

LabelScene::LabelScene() : _resources(std::make_unique<LabelResources>()) {}

LabelScene::LabelScene(const LabelScene& other, const osg::CopyOp& copyop)
    : osgMultiRender::SurfaceGroup(other, copyop), _settings(other._settings),
      _resources(std::make_unique<LabelResources>())
{
}

LabelScene::~LabelScene() = default;

bool LabelScene::setText(std::uint32_t identifier, const std::string& text)
{
    LabelTable::Codes codes(text.begin(), text.end());
    return _resources->table->setCodes(identifier, codes);
}

void LabelScene::setSettings(const LabelSettings& settings)
{
    _settings = settings;
}

namespace
{
class Interim : public osg::NodeVisitor
{
public:
    Interim(LabelScene& s) : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN), scene(s) {}
    void apply(osg::Drawable& drawable) override
    {
        const osg::BoundingBox b = drawable.getBoundingBox();
        ObjectRecord r;
        r.origin = {b.center().x(), b.center().y(), b.center().z()};
        r.size = 0.5f * glm::vec3(b.xMax() - b.xMin(), b.yMax() - b.yMin(), b.zMax() - b.zMin());
        r.shape = 1;
        std::string name;
        for (auto i = getNodePath().rbegin(); i != getNodePath().rend() && name.empty(); ++i)
            name = (*i)->getName();
        r.identifier = ++last;
        scene.setText(last, name.empty() ? "unnamed" : name);
        scene.getResources().objects.add(drawable, r);
    }
    LabelScene& scene;
    std::uint32_t last = 0;
};
} // namespace

void LabelScene::traverse(osg::NodeVisitor& visitor)
{
    static bool once = false;
    if (!once && visitor.getVisitorType() == osg::NodeVisitor::CULL_VISITOR)
    {
        once = true;
        Interim i(*this);
        for (unsigned int c = 0; c < getNumChildren(); ++c)
            getChild(c)->accept(i);
    }
    osgMultiRender::SurfaceGroup::traverse(visitor);
}

void LabelScene::releaseGLObjects(osg::State* state) const
{
    osgMultiRender::SurfaceGroup::releaseGLObjects(state);
    _resources->releaseGLObjects(state);
}

std::unique_ptr<osgMultiRender::SurfacePass> LabelScene::createPass() const
{
    return std::make_unique<LabelPass>(*this);
}

} // namespace osgLabels
