// SPDX-License-Identifier: MIT
#pragma once

#include <osg/BufferObject>
#include <osg/State>

#include <cstdint>
#include <deque>
#include <vector>

namespace osgLabels
{

/// States of map labels on their way from the GPU. Nobody waits for them: they come two frames
/// late, or later where the GPU is farther behind. In the thread of one graphics context.
class MapFeedback
{
public:
    struct State
    {
        bool isHidden = false;
        float since = 0.0f; ///< As mapTest.frag writes it.
    };
    using Keys = std::vector<std::uint64_t>;
    using States = std::vector<State>;

    /// Reads the first rows of what is bound for reading; `keys` are its texels'.
    void start(osg::State& state, Keys keys, int rowLength, int rows);
    /// What has come; false where nothing has.
    bool take(osg::State& state, Keys& keys, States& states);
    /// At once, which waits.
    static States readNow(std::size_t count, int rowLength, int rows);
    /// What is on its way counts no more.
    void drop(osg::State& state);

private:
    struct Way
    {
        Keys keys;
        osg::ref_ptr<osg::PixelDataBufferObject> buffer;
        GLsync fence = nullptr; ///< Goes with its context if this dies on the way.
    };
    static States statesOf(const std::vector<float>& texels, std::size_t count);

    std::deque<Way> _ways;
    std::vector<osg::ref_ptr<osg::PixelDataBufferObject>> _free;
};

} // namespace osgLabels
