// SPDX-License-Identifier: MIT
#include <osgPagedTexture/PagedLods.h>

#include <osgPagedTexture/FileImages.h>
#include <osgPagedTexture/PagedTextures.h>
#include <osgPagedTexture/Pager.h>
#include <osgPagedTexture/StandInCallback.h>

#include <osg/NodeVisitor>
#include <osg/PagedLOD>
#include <osg/ProxyNode>
#include <osgDB/Options>

namespace osgPagedTexture
{

namespace
{

/// Reads nodes for a pager, in the thread that asks.
class PagedReader : public StandInCallback
{
public:
    PagedReader(osgDB::ReadFileCallback* next, const std::shared_ptr<Pager>& pager)
        : StandInCallback(next), _pager(pager)
    {
    }

    Result readNode(const std::string& name, const osgDB::Options* options) override
    {
        const std::shared_ptr<Pager> pager = _pager.lock();
        // A nested file of a model that is being read for a pager belongs to that.
        if (!pager || FileImages::current())
            return StandInCallback::readNode(name, options);
        const FileImages images;
        Result result = StandInCallback::readNode(name, options);
        if (result.validNode())
        {
            pageTextures(*result.getNode(), pager, &images);
            pageLater(*result.getNode(), pager);
        }
        return result;
    }

    bool isOf(const Pager& pager) const { return _pager.lock().get() == &pager; }

private:
    const std::weak_ptr<Pager> _pager;
};

class LaterVisitor : public osg::NodeVisitor
{
public:
    explicit LaterVisitor(const std::shared_ptr<Pager>& pager)
        : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN), _pager(pager)
    {
    }

    void apply(osg::PagedLOD& lod) override { give(lod); }
    void apply(osg::ProxyNode& proxy) override { give(proxy); }

private:
    template <class Reading> void give(Reading& node)
    {
        auto* before = dynamic_cast<osgDB::Options*>(node.getDatabaseOptions());
        osgDB::ReadFileCallback* next = before ? before->getReadFileCallback() : nullptr;
        const auto* ours = dynamic_cast<PagedReader*>(next);
        if (!ours || !ours->isOf(*_pager))
        {
            osg::ref_ptr<osgDB::Options> options =
                before ? before->cloneOptions() : new osgDB::Options;
            options->setReadFileCallback(new PagedReader(next, _pager));
            node.setDatabaseOptions(options);
        }
        traverse(node);
    }

    const std::shared_ptr<Pager> _pager;
};

} // namespace

void pageLater(osg::Node& node, const std::shared_ptr<Pager>& pager)
{
    LaterVisitor visitor(pager);
    node.accept(visitor);
}

} // namespace osgPagedTexture
