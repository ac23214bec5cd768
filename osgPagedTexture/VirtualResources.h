// SPDX-License-Identifier: MIT
// What a VirtualScene keeps from frame to frame. Not installed.
#pragma once

#include <osgPagedTexture/VirtualContext.h>
#include <osgPagedTexture/VirtualSettings.h>
#include <osgPagedTexture/VirtualTexture.h>
#include <osgPagedTexture/VirtualUpdate.h>

#include <osg/observer_ptr>

#include <atomic>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace osgPagedTexture
{

/// The pager and the contexts of a VirtualScene. Thread safe but for what it gives out.
class VirtualResources
{
public:
    void setSettings(const VirtualSettings& settings);
    VirtualSettings getSettings() const;

    /// A texture of the scene, whose file is known.
    void add(VirtualTexture& texture);
    bool hasTextures() const;

    /// The context's, in its draw thread; null where no store can be read.
    osg::ref_ptr<VirtualContext> contextOf(osg::State& state);

    /// The pager's number of a texture; -1 where its store can't be read. Opens the store.
    int numberOf(const VirtualTexture& texture);

    /// The pager; null before the first frame.
    std::shared_ptr<VirtualPager> getPager() const;

    /// The number of a step of the pager: in each frame one, or another one where `isNew`.
    unsigned int step(unsigned int frame, bool isNew = false);

    /// Reads all stores again, whether or not they say that they have changed.
    void reload();

    /// Brings them up to date with their photographs, in the background, and reads them again.
    void update();

    /// Says what the pager has to tell the user.
    void say(double seconds);

    /// A view's part of being at rest, by its pass.
    void setBusy(const osg::Camera* camera, unsigned int frame, bool isBusy);
    bool isAtRest() const;

    struct Line
    {
        std::string file;
        std::int64_t width = 0, height = 0; ///< Texels.
        std::uint64_t pages = 0;            ///< On all levels.
        std::string error;
    };
    std::vector<Line> getLines() const;

    void releaseGLObjects(osg::State* state);

private:
    struct Store
    {
        int number = -1;
        bool isTried = false;
        Line line;
    };
    void makePager(osg::State& state);
    void open(Store& store);
    void reload(Store& store);

    mutable std::mutex _mutex;
    VirtualSettings _settings;
    std::map<std::string, Store> _stores; ///< By file.
    std::shared_ptr<VirtualPager> _pager;
    SlotGrid _slots;
    std::map<unsigned int, osg::ref_ptr<VirtualContext>> _contexts;
    struct Busy
    {
        unsigned int frame = 0;
        bool isBusy = true;
    };
    std::map<const osg::Camera*, Busy> _busy;
    unsigned int _lastFrame = 0;
    bool _hasFrame = false;
    unsigned int _step = 0;
    double _saidAt = -1e9;
    VirtualUpdate _update; ///< The last member: its thread uses the others.
};

} // namespace osgPagedTexture
