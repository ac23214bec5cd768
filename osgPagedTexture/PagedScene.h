// SPDX-License-Identifier: MIT
#pragma once

#include <osgPagedTexture/Export.h>
#include <osgPagedTexture/PagedSettings.h>
#include <osgPagedTexture/PagerStatistics.h>
#include <osgPagedTexture/SavedImages.h>

#include <osgMultiRender/Plan.h>

#include <osg/Group>
#include <osgDB/ReaderWriter>

#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

namespace osgUtil
{
class CullVisitor;
} // namespace osgUtil

namespace osgPagedTexture
{

class EyeMotion;
class FileImages;
class Pager;
class SurfaceCache;

/// A scene whose 2D textures are read, compressed and uploaded in the background, as fine as what
/// is in view needs and as its share of memory allows.
///
/// The model keeps its osg::Texture2D objects with all of their parameters. Each starts as one grey
/// texel, then as a small preview, then gets finer; what is no longer needed goes when the memory
/// is short. What its PagedLOD objects read later is paged, too. Textures that fit all together are
/// loaded whole, when they come into view. Nothing is read and no thread started before the first
/// frame that shows a texture.
class OSGPAGEDTEXTURE_EXPORT PagedScene : public osg::Group, public osgMultiRender::Planned
{
public:
    PagedScene();
    PagedScene(const PagedScene& other, const osg::CopyOp& copyop = osg::CopyOp::SHALLOW_COPY);
    META_Node(osgPagedTexture, PagedScene)

    /// Counts from the next frame on; cache and threads only before the first one.
    void setSettings(const PagedSettings& settings);
    const PagedSettings& getSettings() const { return _settings; }
    /// As text, "gpu='64'": all that differ from the defaults. What is unknown or wrong in it is
    /// named in a warning and does not count.
    void setSettingsText(const std::string& text);
    std::string getSettingsText() const;

    /// Reads a model, its textures' images left out, and adds it as a child. The result is that of
    /// the reader. In the calling thread.
    osgDB::ReaderWriter::ReadResult readModel(const std::string& file,
                                              const osgDB::Options* options = nullptr);

    /// Takes over the textures of a subgraph that was read as ever, now and not while it is drawn:
    /// those whose images come from files lose these images.
    void install(osg::Node& subgraph);

    /// Whether all that was in view in the last frame is there as fine as the memory allows.
    bool isAtRest() const;

    PagerStatistics getStatistics() const;
    std::vector<osgMultiRender::Plan> getPlans() const override;

    void traverse(osg::NodeVisitor& visitor) override;

    const std::shared_ptr<Pager>& getPager() const { return _pager; }

protected:
    ~PagedScene() override;

private:
    struct Views;

    void cull(osgUtil::CullVisitor& visitor);
    void lookAhead(osgUtil::CullVisitor& visitor, const EyeMotion& motion, double seconds,
                   unsigned int frame);
    void take(osg::Node& subgraph, const FileImages* images);

    PagedSettings _settings;
    const std::shared_ptr<Pager> _pager;
    const std::shared_ptr<SurfaceCache> _surfaces;
    const osg::ref_ptr<osg::StateSet> _scope; ///< Its leaves in a StateGraph of their own.
    const std::unique_ptr<Views> _views;
    const SavedImages _savedImages;
    bool _isInstalled = false;
    std::vector<std::pair<std::string, std::string>> _left; ///< Not paged, and why.
};

/// Puts a PagedScene over a subgraph and takes its textures over, see PagedScene::install().
OSGPAGEDTEXTURE_EXPORT osg::ref_ptr<PagedScene> install(osg::Node& subgraph,
                                                        const PagedSettings& settings = {});

} // namespace osgPagedTexture
