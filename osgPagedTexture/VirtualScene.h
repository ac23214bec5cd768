// SPDX-License-Identifier: MIT
#pragma once

#include <osgPagedTexture/Export.h>
#include <osgPagedTexture/VirtualPager.h>
#include <osgPagedTexture/VirtualSettings.h>

#include <osgMultiRender/SurfaceGroup.h>

#include <osgDB/ReaderWriter>

#include <memory>
#include <string>

namespace osgPagedTexture
{

class VirtualResources;

/// A scene whose VirtualTextures are paged: of tile stores of any size the pages that are in view
/// are read, encoded and uploaded in the background, within budgets.
///
/// Which pages are needed the GPU says, in a small picture that is drawn beside the view while
/// something moves. What has not come yet is shown by coarser pages. Several textures, views and
/// contexts share pages in memory; each context has its own on the GPU. Surfaces are drawn by the
/// surface functions, so that lights, shadows and labels of other kits work on top. Requires OpenGL
/// 3.3 compatibility; below that the textures show their images.
class OSGPAGEDTEXTURE_EXPORT VirtualScene : public osgMultiRender::SurfaceGroup
{
public:
    VirtualScene();
    VirtualScene(const VirtualScene& other, const osg::CopyOp& copyop = osg::CopyOp::SHALLOW_COPY);
    META_Node(osgPagedTexture, VirtualScene)

    /// Counts from the next frame on; budgets, format and threads only before the first one.
    void setSettings(const VirtualSettings& settings);
    VirtualSettings getSettings() const;
    /// As text, "gpu='64'": all that differ from the defaults. What is unknown or wrong in it is
    /// named in a warning and does not count.
    void setSettingsText(const std::string& text);
    std::string getSettingsText() const;

    /// Finds the stores of all VirtualTextures of the subgraph and of 2D textures that name one by
    /// the user value `osgPagedTexture.store`, as models of `osgtilestore atlas` do. With
    /// VirtualSettings::store these show that one; where none names a store, all 2D textures of
    /// unit 0 do; where there are none, the whole subgraph. Relative
    /// paths are looked for in the options' folders and OSG's. Now, and not while it is drawn; a
    /// scene from a file does it at its first frame. Images become the stores' coarsest pages.
    void install(const osgDB::Options* options = nullptr);

    /// Reads stores again, also those that could not be read. What is shown goes over to a changed
    /// store in one frame, when all its pages in view are there.
    void reload();

    /// What key `u` does: brings the stores up to date with the photographs they were built from,
    /// as `osgtilestore update` does, in the background, and reads them again. Stores that know no
    /// photographs are only read again. What was done and what went wrong is said by osg::notify().
    void update();

    /// Whether all that was in view in the last frames is there as fine as the memory allows.
    bool isAtRest() const;

    /// Of the pages; all zero before the first frame.
    VirtualPagerStatistics getStatistics() const;

    void traverse(osg::NodeVisitor& visitor) override;
    void releaseGLObjects(osg::State* state = nullptr) const override;

protected:
    ~VirtualScene() override;

    std::unique_ptr<osgMultiRender::SurfacePass> createPass() const override;

private:
    const std::shared_ptr<VirtualResources> _resources;
    bool _isInstalled = false;
};

} // namespace osgPagedTexture
