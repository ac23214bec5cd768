// SPDX-License-Identifier: MIT
// A VirtualScene's textures in one graphics context. Not installed.
#pragma once

#include <osgPagedTexture/UploadTexture.h>
#include <osgPagedTexture/VirtualFeedback.h>
#include <osgPagedTexture/VirtualPager.h>
#include <osgPagedTexture/VirtualTables.h>
#include <osgPagedTexture/VirtualTexture.h>

#include <osg/Camera>
#include <osg/StateSet>
#include <osg/observer_ptr>

#include <map>
#include <memory>
#include <set>

namespace osgPagedTexture
{

/// Where the slots of a physical texture lie.
struct SlotGrid
{
    int side = 0; ///< Texels of a slot.
    int columns = 0, rows = 0;

    /// As many slots as fit the bytes and the largest texture, one at least.
    static SlotGrid fit(std::uint64_t bytes, std::uint64_t pageBytes, int side, int maxSide);
    int count() const { return columns * rows; }
};

/// The physical texture, the tables and the feedback of each view. In the draw thread of its
/// context.
class VirtualContext : public osg::Referenced
{
public:
    enum Unit : unsigned int
    {
        TableUnit = 18,
        PagesUnit = 19
    };

    VirtualContext(unsigned int contextID, std::shared_ptr<VirtualPager> pager,
                   const SlotGrid& slots);

    /// The texture shows the pager's of this number.
    void add(std::uint32_t number, const VirtualTexture& texture);

    const TileGrid& getGrid(std::uint32_t number) const { return _shown.at(number).grid; }

    /// Pages and tables that the pager has for it; of pages about `milliseconds`' worth. Returns
    /// whether that was all. `seconds` is the time.
    bool upload(osg::State& state, double milliseconds, double seconds);

    /// What a view remembers from frame to frame.
    struct View
    {
        /// Reduced pictures of a view at rest, before those of all its pixels.
        static constexpr unsigned int CalmPictures = 8;
        /// Pictures of all pixels that a frame takes which waits for its pages.
        static constexpr unsigned int WaitingPictures = 4;

        std::unique_ptr<VirtualFeedback> feedback;
        unsigned int number = 0;     ///< With the pager.
        std::uint64_t seen = 0;      ///< Hash of what was drawn.
        unsigned int calmFrames = 0; ///< Feedback pictures since it has changed.
        unsigned int lastUse = 0;
        bool isReported = false;
    };
    View& viewOf(const osg::Camera* camera);

    const std::shared_ptr<VirtualPager>& getPager() const { return _pager; }
    const SlotGrid& getSlots() const { return _slots; }
    const VirtualTables& getTables() const { return _tables; }
    UploadTexture& getPages() const { return *_pages; }
    /// The textures at their units.
    const osg::StateSet& getStateSet() const { return *_stateSet; }
    /// When the last page came, in seconds.
    double getLastArrival() const { return _lastArrival; }
    std::uint64_t getLastUploaded() const { return _lastUploaded; }
    std::size_t getLastPages() const { return _lastPages; }

    void releaseGLObjects(osg::State* state);

protected:
    ~VirtualContext() override;

private:
    void apply(osg::State& state, const PageUploads& uploads, double seconds);
    void showCoarsest(osg::State& state);
    Pixels pictureOf(std::uint32_t number, const PageTexels& texels) const;

    const unsigned int _contextID;
    const std::shared_ptr<VirtualPager> _pager;
    const SlotGrid _slots;
    /// What virtual textures have beside their pages.
    struct Shown
    {
        TileGrid grid;
        std::set<osg::observer_ptr<const VirtualTexture>> textures;
        std::shared_ptr<const PageTexels> coarsest; ///< That their image is.
    };
    std::map<std::uint32_t, Shown> _shown;
    /// The coarsest pages of textures, by slot.
    std::map<int, std::shared_ptr<const PageTexels>> _coarsest;
    VirtualTables _tables;
    osg::ref_ptr<UploadTexture> _pages;
    osg::ref_ptr<osg::StateSet> _stateSet;
    std::map<const osg::Camera*, View> _views;
    unsigned int _uses = 0;
    double _lastArrival = -1e9;
    std::uint64_t _lastUploaded = 0;
    std::size_t _lastPages = 0;
};

} // namespace osgPagedTexture
