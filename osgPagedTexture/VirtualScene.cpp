// SPDX-License-Identifier: MIT
#include <osgPagedTexture/VirtualScene.h>

#include <osgPagedTexture/VirtualKeys.h>
#include <osgPagedTexture/VirtualOptions.h>
#include <osgPagedTexture/VirtualPass.h>

#include <osg/NodeVisitor>
#include <osg/Notify>
#include <osgGA/EventVisitor>

#include <map>

namespace osgPagedTexture
{

namespace
{

/// Replaces textures by virtual ones where a store is said, and finds those that there are.
class Installer : public osg::NodeVisitor
{
public:
    explicit Installer(const std::string& store)
        : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN), _store(store)
    {
    }

    void apply(osg::Node& node) override
    {
        if (osg::StateSet* stateSet = node.getStateSet())
            visit(*stateSet);
        traverse(node);
    }
    void apply(osg::Drawable& drawable) override { apply(static_cast<osg::Node&>(drawable)); }

    std::map<osg::Texture2D*, osg::ref_ptr<VirtualTexture>> textures; ///< Virtual ones themselves.

private:
    void visit(osg::StateSet& stateSet)
    {
        for (unsigned int unit = 0; unit < stateSet.getNumTextureAttributeLists(); ++unit)
        {
            auto* texture = dynamic_cast<osg::Texture2D*>(
                stateSet.getTextureAttribute(unit, osg::StateAttribute::TEXTURE));
            if (!texture)
                continue;
            auto* already = dynamic_cast<VirtualTexture*>(texture);
            if (already)
                textures[texture] = already;
            else if (unit == 0 && !_store.empty())
                replace(stateSet, *texture);
        }
    }

    void replace(osg::StateSet& stateSet, osg::Texture2D& texture)
    {
        const auto pair = stateSet.getTextureAttributePair(0, osg::StateAttribute::TEXTURE);
        const osg::StateAttribute::OverrideValue value = pair->second;
        // Kept, so that no other texture gets its address.
        _replaced.emplace_back(&texture);
        osg::ref_ptr<VirtualTexture>& own = textures[&texture];
        if (!own)
            own = new VirtualTexture(texture, _store);
        stateSet.setTextureAttribute(0, own, value);
    }

    const std::string _store;
    std::vector<osg::ref_ptr<osg::Texture2D>> _replaced;
};

} // namespace

VirtualScene::VirtualScene() : _resources(std::make_shared<VirtualResources>())
{
    // So that parents lead event visitors here.
    setNumChildrenRequiringEventTraversal(getNumChildrenRequiringEventTraversal() + 1);
}

VirtualScene::VirtualScene(const VirtualScene& other, const osg::CopyOp& copyop)
    : SurfaceGroup(other, copyop), _resources(std::make_shared<VirtualResources>())
{
    _resources->setSettings(other.getSettings());
    setNumChildrenRequiringEventTraversal(getNumChildrenRequiringEventTraversal() + 1);
}

VirtualScene::~VirtualScene() = default;

void VirtualScene::setSettings(const VirtualSettings& settings)
{
    _resources->setSettings(settings);
}

VirtualSettings VirtualScene::getSettings() const
{
    return _resources->getSettings();
}

void VirtualScene::setSettingsText(const std::string& text)
{
    VirtualSettings settings;
    for (const std::string& error : parseVirtualOptions(settings, text))
        OSG_WARN << "osgPagedTexture::VirtualScene: " << error << "; it does not count"
                 << std::endl;
    setSettings(settings);
}

std::string VirtualScene::getSettingsText() const
{
    return formatVirtualOptions(getSettings());
}

void VirtualScene::install(const osgDB::Options* options)
{
    _isInstalled = true;
    const std::string store = getSettings().store;
    Installer installer(store);
    accept(installer);
    if (installer.textures.empty() && !store.empty())
    {
        const osg::ref_ptr<VirtualTexture> whole = new VirtualTexture(store);
        getOrCreateStateSet()->setTextureAttributeAndModes(0, whole);
        installer.textures[whole] = whole;
    }
    for (const auto& each : installer.textures)
    {
        VirtualTexture& texture = *each.second;
        // One from a file was found when that was read. What can't be read is said when it is
        // drawn.
        if (texture.getFile() != texture.getStore() || texture.find(options))
            texture.loadImage();
        _resources->add(texture);
    }
}

void VirtualScene::update()
{
    _resources->invalidate();
}

bool VirtualScene::isAtRest() const
{
    return _resources->isAtRest();
}

VirtualPagerStatistics VirtualScene::getStatistics() const
{
    const std::shared_ptr<VirtualPager> pager = _resources->getPager();
    return pager ? pager->getStatistics() : VirtualPagerStatistics();
}

void VirtualScene::traverse(osg::NodeVisitor& visitor)
{
    if (!_isInstalled && (visitor.getVisitorType() == osg::NodeVisitor::UPDATE_VISITOR ||
                          visitor.getVisitorType() == osg::NodeVisitor::EVENT_VISITOR))
        install();
    SurfaceGroup::traverse(visitor);
    if (visitor.getVisitorType() != osg::NodeVisitor::EVENT_VISITOR)
        return;
    auto& events = static_cast<osgGA::EventVisitor&>(visitor);
    if (getSettings().keys)
        answerKeys(*this, events);
    if (events.getActionAdapter() && !isAtRest())
        events.getActionAdapter()->requestRedraw();
}

void VirtualScene::releaseGLObjects(osg::State* state) const
{
    SurfaceGroup::releaseGLObjects(state);
    _resources->releaseGLObjects(state);
}

std::unique_ptr<osgMultiRender::SurfacePass> VirtualScene::createPass() const
{
    return std::make_unique<VirtualPass>(_resources);
}

} // namespace osgPagedTexture
