// SPDX-License-Identifier: MIT
#pragma once

#include <osgLabels/MapClasses.h>

#include <osg/StateSet>

#include <map>
#include <mutex>
#include <string>
#include <tuple>

namespace osgLabels
{

/// The programs that draw map labels. Thread safe.
class MapPrograms
{
public:
    struct Kind
    {
        int language = 330; ///< Of GLSL, times 100.
        int layers = 0;     ///< Actions in use.
        bool next = false;
        bool states = false;   ///< Labels are hidden as a whole.
        bool isTest = false;   ///< The program that finds the states,
        bool anchored = false; ///< from anchors,
        bool wholly = false;   ///< or that says whether nothing of a label is seen.

        auto tied() const
        {
            return std::tie(language, layers, next, states, isTest, anchored, wholly);
        }
        bool operator<(const Kind& other) const { return tied() < other.tied(); }
    };

    enum Unit
    {
        LabelsUnit = 2, ///< Beside those of MapTargets.
        StatesUnit = 3
    };

    /// Program and state, with OVERRIDE. `defines`: of the glyphs and buffers.
    const osg::StateSet* get(const Kind& kind, const std::string& defines);

    void releaseGLObjects(osg::State* state);

private:
    std::mutex _mutex;
    std::map<std::pair<Kind, std::string>, osg::ref_ptr<osg::StateSet>> _stateSets;
};

} // namespace osgLabels
