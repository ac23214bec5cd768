// SPDX-License-Identifier: MIT
#include <osgPagedTexture/VirtualScene.h>

#include <osgPagedTexture/VirtualKeys.h>
#include <osgPagedTexture/VirtualOptions.h>
#include <osgPagedTexture/VirtualPass.h>

#include <osg/NodeVisitor>
#include <osg/Notify>
#include <osg/ValueObject>
#include <osgGA/EventVisitor>

#include <map>
#include <vector>

namespace osgPagedTexture
{

namespace
{

/// Finds virtual textures, and puts them in the place of those that name a store by their user
/// value.
class Installer : public osg::NodeVisitor
{
public:
    /// `store`: instead of what the textures name; then, where none names one, all of unit 0 show
    /// it.
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

    void finish()
    {
        if (!_store.empty() && textures.empty())
            for (const osg::ref_ptr<osg::StateSet>& each : _others)
                replace(*each, 0, _store);
    }

    std::map<osg::Texture2D*, osg::ref_ptr<VirtualTexture>> textures; ///< Virtual ones themselves.

private:
    static osg::Texture2D* textureOf(const osg::StateSet& stateSet, unsigned int unit)
    {
        return dynamic_cast<osg::Texture2D*>(const_cast<osg::StateAttribute*>(
            stateSet.getTextureAttribute(unit, osg::StateAttribute::TEXTURE)));
    }

    void visit(osg::StateSet& stateSet)
    {
        for (unsigned int unit = 0; unit < stateSet.getNumTextureAttributeLists(); ++unit)
        {
            osg::Texture2D* texture = textureOf(stateSet, unit);
            std::string named;
            if (!texture)
                continue;
            if (auto* already = dynamic_cast<VirtualTexture*>(texture))
                textures[texture] = already;
            else if (texture->getUserValue("osgPagedTexture.store", named) && !named.empty())
                replace(stateSet, unit, _store.empty() ? named : _store);
            else if (unit == 0)
                _others.emplace_back(&stateSet);
        }
    }

    void replace(osg::StateSet& stateSet, unsigned int unit, const std::string& store)
    {
        osg::Texture2D* texture = textureOf(stateSet, unit);
        const osg::StateAttribute::OverrideValue value =
            stateSet.getTextureAttributePair(unit, osg::StateAttribute::TEXTURE)->second;
        // Kept, so that no other texture gets its address.
        _replaced.emplace_back(texture);
        osg::ref_ptr<VirtualTexture>& own = textures[texture];
        if (!own)
            own = new VirtualTexture(*texture, store);
        stateSet.setTextureAttribute(unit, own, value);
    }

    const std::string _store;
    std::vector<osg::ref_ptr<osg::StateSet>>
        _others; ///< With a texture in unit 0, naming no store.
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
    installer.finish();
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

void VirtualScene::reload()
{
    _resources->reload();
}

void VirtualScene::update()
{
    _resources->update();
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
