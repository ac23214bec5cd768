// SPDX-License-Identifier: MIT
#include <osgPagedTexture/PagedScene.h>

#include <osgPagedTexture/EyeMotion.h>
#include <osgPagedTexture/FileImages.h>
#include <osgPagedTexture/NeedCollector.h>
#include <osgPagedTexture/PagedGraph.h>
#include <osgPagedTexture/PagedKeys.h>
#include <osgPagedTexture/PagedLods.h>
#include <osgPagedTexture/PagedOptions.h>
#include <osgPagedTexture/PagedTextures.h>
#include <osgPagedTexture/Pager.h>
#include <osgPagedTexture/SoonCollector.h>
#include <osgPagedTexture/ThreadClock.h>

#include <osg/GraphicsContext>
#include <osg/Notify>
#include <osg/observer_ptr>
#include <osgDB/Registry>
#include <osgGA/EventVisitor>
#include <osgUtil/CullVisitor>

#include <map>

namespace osgPagedTexture
{

namespace
{

/// The uploads of a context, after each of its frames.
class UploadOperation : public osg::GraphicsOperation
{
public:
    explicit UploadOperation(const std::shared_ptr<Pager>& pager)
        : osg::Referenced(true), osg::GraphicsOperation("osgPagedTexture", true), _pager(pager)
    {
    }

    void operator()(osg::GraphicsContext* context) override
    {
        if (const std::shared_ptr<Pager> pager = _pager.lock())
            pager->upload(*context->getState());
        else
            setKeep(false);
    }

private:
    const std::weak_ptr<Pager> _pager;
};

} // namespace

struct PagedScene::Views
{
    std::mutex mutex;
    std::map<const osg::Camera*, EyeMotion> eyes; ///< In coordinates of the scene.
    double prefetchMilliseconds = 0.0;            ///< Of the last frame.
    std::map<osg::GraphicsContext*, osg::observer_ptr<osg::GraphicsContext>> contexts;
    PagedGraph graph;
};

PagedScene::PagedScene()
    : _pager(std::make_shared<Pager>(_settings)), _surfaces(std::make_shared<SurfaceCache>()),
      _scope(new osg::StateSet), _views(std::make_unique<Views>())
{
    // So that parents lead event visitors here; not for children, which have their own.
    setNumChildrenRequiringEventTraversal(getNumChildrenRequiringEventTraversal() + 1);
}

PagedScene::PagedScene(const PagedScene& other, const osg::CopyOp& copyop)
    : osg::Group(other, copyop), osgMultiRender::Planned(), _settings(other._settings),
      _pager(other._pager), _surfaces(other._surfaces), _scope(new osg::StateSet),
      _views(std::make_unique<Views>()), _savedImages(), _isInstalled(other._isInstalled),
      _left(other._left)
{
    setNumChildrenRequiringEventTraversal(getNumChildrenRequiringEventTraversal() + 1);
}

PagedScene::~PagedScene() = default;

void PagedScene::setSettings(const PagedSettings& settings)
{
    _settings = settings;
    _pager->setSettings(settings);
}

void PagedScene::setSettingsText(const std::string& text)
{
    PagedSettings settings;
    for (const std::string& error : parsePagedOptions(settings, text))
        OSG_WARN << "osgPagedTexture::PagedScene: " << error << "; it does not count" << std::endl;
    setSettings(settings);
}

std::string PagedScene::getSettingsText() const
{
    return formatPagedOptions(_settings);
}

osgDB::ReaderWriter::ReadResult PagedScene::readModel(const std::string& file,
                                                      const osgDB::Options* options)
{
    const FileImages images;
    const osg::ref_ptr<const osgDB::Options> own = images.optionsFor(options);
    osgDB::ReaderWriter::ReadResult result = osgDB::Registry::instance()->readNode(file, own.get());
    if (!result.validNode())
        return result;
    take(*result.getNode(), &images);
    addChild(result.getNode());
    return result;
}

void PagedScene::install(osg::Node& subgraph)
{
    take(subgraph, nullptr);
}

void PagedScene::take(osg::Node& subgraph, const FileImages* images)
{
    for (const LeftTexture& left : pageTextures(subgraph, _pager, images))
        _left.emplace_back(left.name, left.reason);
    pageLater(subgraph, _pager);
    findSurfaces(subgraph, *_surfaces);
    _isInstalled = true;
}

bool PagedScene::isAtRest() const
{
    return _pager->isAtRest();
}

PagerStatistics PagedScene::getStatistics() const
{
    PagerStatistics statistics = _pager->getStatistics();
    std::lock_guard<std::mutex> lock(_views->mutex);
    statistics.prefetchMilliseconds = _views->prefetchMilliseconds;
    return statistics;
}

void PagedScene::traverse(osg::NodeVisitor& visitor)
{
    osgUtil::CullVisitor* cullVisitor = visitor.asCullVisitor();
    if (visitor.getVisitorType() == osg::NodeVisitor::CULL_VISITOR && cullVisitor &&
        cullVisitor->getCurrentRenderBin())
        cull(*cullVisitor);
    else
        osg::Group::traverse(visitor);
    if (visitor.getVisitorType() != osg::NodeVisitor::EVENT_VISITOR)
        return;
    auto& events = static_cast<osgGA::EventVisitor&>(visitor);
    if (_settings.keys)
        answerKeys(*this, events);
    if (events.getActionAdapter() && !_pager->isAtRest())
        events.getActionAdapter()->requestRedraw();
}

void PagedScene::cull(osgUtil::CullVisitor& visitor)
{
    {
        // One that comes from a file, with its model below it.
        std::lock_guard<std::mutex> lock(_views->mutex);
        if (!_isInstalled)
            take(*this, nullptr);
    }
    const osg::FrameStamp* stamp = visitor.getFrameStamp();
    const unsigned int frame = stamp ? stamp->getFrameNumber() : 0;
    _pager->advance(frame);

    EyeMotion motion;
    {
        std::lock_guard<std::mutex> lock(_views->mutex);
        EyeMotion& eye = _views->eyes[visitor.getCurrentCamera()];
        eye.see(*visitor.getModelViewMatrix(), stamp ? stamp->getReferenceTime() : 0.0);
        motion = eye;
        osg::GraphicsContext* context =
            visitor.getState() ? visitor.getState()->getGraphicsContext() : nullptr;
        osg::observer_ptr<osg::GraphicsContext>* known =
            context ? &_views->contexts[context] : nullptr;
        if (known && !known->valid()) // Addresses are given again.
        {
            *known = context;
            context->add(new UploadOperation(_pager));
        }
    }

    visitor.pushStateSet(_scope.get());
    const osgUtil::StateGraph* graph = visitor.getCurrentStateGraph();
    osg::Group::traverse(visitor);
    visitor.popStateSet();
    if (_settings.graph)
        _views->graph.cull(visitor, *_pager);
    const double ahead = _settings.prefetchSeconds;
    _pager->report(collectDemands(*graph, visitor, *_pager, *_surfaces, motion.placeAfter(ahead)),
                   frame);
    if (ahead > 0.0 && !motion.isStill())
        lookAhead(visitor, motion, ahead, frame);
}

/// What the eye will see half of the time ahead and all of it, in turns: what comes into view from
/// the sides and from behind corners has no leaf yet.
void PagedScene::lookAhead(osgUtil::CullVisitor& visitor, const EyeMotion& motion, double seconds,
                           unsigned int frame)
{
    const double start = threadMilliseconds();
    const osg::Matrixd projection(*visitor.getProjectionMatrix());
    SoonCollector collector(*_pager, *_surfaces, viewThrough(projection, visitor.getViewport()),
                            projection,
                            osg::Matrixd(*visitor.getModelViewMatrix()) *
                                motion.after(frame % 2 ? seconds : 0.5 * seconds));
    collector.setTraversalMask(visitor.getTraversalMask());
    collector.setNodeMaskOverride(visitor.getNodeMaskOverride());
    osg::Group::traverse(collector);
    _pager->report(collector.takeDemands(), frame);
    std::lock_guard<std::mutex> lock(_views->mutex);
    _views->prefetchMilliseconds = threadMilliseconds() - start;
}

std::vector<osgMultiRender::Plan> PagedScene::getPlans() const
{
    using Decision = osgMultiRender::PlanEntry::Decision;
    constexpr std::size_t maxPlanned = 64;
    osgMultiRender::Plan plan;
    plan.kit = "osgPagedTexture::PagedScene";
    plan.view = "all";
    const PagerStatistics statistics = getStatistics();
    std::size_t named = 0;
    for (const Pager::Line& line : _pager->getLines())
    {
        if (named++ >= maxPlanned)
            continue;
        const std::string size = std::to_string(line.width) + "x" + std::to_string(line.height);
        constexpr const char* uses[] = {"", ", data", ", normals", ", normals (x, y)"};
        osgMultiRender::PlanEntry entry{
            "texture '" + line.file + "' " + size + uses[int(line.use)], Decision::Drawn, {}};
        if (line.failed)
            entry = {entry.subject, Decision::Dropped, "it can't be read; a placeholder is shown"};
        else if (line.wanted < 0 && line.level < 0)
            entry = {entry.subject, Decision::Dropped, "nothing in view uses it"};
        else
            entry.reason = "level " + std::to_string(line.level) + " is there, " +
                           std::to_string(line.wanted) + " is its share" +
                           (statistics.isWhole ? ", since all fit at full size" : "");
        plan.entries.push_back(entry);
    }
    if (named > maxPlanned)
        plan.entries.push_back({std::to_string(named - maxPlanned) + " more textures",
                                Decision::Folded, "only the first ones are listed"});
    std::vector<std::pair<std::string, std::string>> notPaged;
    {
        std::lock_guard<std::mutex> lock(_views->mutex);
        notPaged = _left;
    }
    for (const auto& [name, reason] : notPaged)
        plan.entries.push_back(
            {"texture '" + name + "'", Decision::Folded, "not paged: " + reason});
    const FrameTimes times = _pager->getUploadTimes(), bytes = _pager->getUploadBytes();
    plan.counts = {{"textures", double(statistics.textures)},
                   {"textures.inView", double(statistics.inView)},
                   {"textures.resident", double(statistics.resident)},
                   {"textures.failed", double(statistics.failed)},
                   {"textures.considered", double(statistics.considered)},
                   {"textures.changing", double(statistics.changing)},
                   {"textures.whole", statistics.isWhole ? 1.0 : 0.0},
                   {"levels.missing", statistics.bias},
                   {"gpu.bytes", double(statistics.upload.bytes)},
                   {"gpu.bytes.peak", double(statistics.upload.peakBytes)},
                   {"gpu.bytes.budget", double(_settings.gpuBytes())},
                   {"gpu.bytes.whole", double(statistics.wholeBytes)},
                   {"cpu.bytes.peak", double(statistics.loader.peakMemoryBytes)},
                   {"files.decoded", double(statistics.loader.filesDecoded)},
                   {"files.bytesRead", double(statistics.loader.bytesRead)},
                   {"cache.hits", double(statistics.loader.cache.hits)},
                   {"cache.bytesRead", double(statistics.loader.cache.bytesRead)},
                   {"upload.bytes", double(statistics.upload.uploaded)},
                   {"upload.bytes.p99", bytes.getPercentile(99.0)},
                   {"upload.madeAside", double(statistics.upload.madeAside)},
                   {"upload.ms.p50", times.getPercentile(50.0)},
                   {"upload.ms.p99", times.getPercentile(99.0)},
                   {"upload.ms.max", times.getLargest()},
                   {"plan.ms", statistics.planMilliseconds},
                   {"prefetch.ms", statistics.prefetchMilliseconds},
                   {"texels.needed", statistics.neededTexels},
                   {"texels.missing", statistics.missingTexels}};
    return {plan};
}

osg::ref_ptr<PagedScene> install(osg::Node& subgraph, const PagedSettings& settings)
{
    osg::ref_ptr<PagedScene> scene = new PagedScene;
    scene->setDataVariance(osg::Object::DYNAMIC);
    scene->setSettings(settings);
    scene->install(subgraph);
    scene->addChild(&subgraph);
    return scene;
}

} // namespace osgPagedTexture
