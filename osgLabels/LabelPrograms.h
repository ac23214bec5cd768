// SPDX-License-Identifier: MIT
#pragma once

#include <osg/Program>
#include <osg/StateSet>

#include <map>
#include <mutex>
#include <string>
#include <tuple>

namespace osgLabels
{

/// GLSL of the label kit, by what it depends on.
struct LabelSources
{
    /// Declares osgLabels_locate(): identifier and place of the fragment.
    /// Needs an int osgLabels_index. `isPaged`: buffers are 2D arrays; `hasPagedRecords`: those of
    /// the object records, too, where the others are.
    static std::string locate(bool isPaged, bool hasPagedRecords);
    /// Declares osgLabels_over(): the colour of a surface with its label.
    static std::string ink();
};

/// The programs of the second pass. Thread safe.
class LabelPrograms
{
public:
    /// Program and state of the pass, with OVERRIDE, for targets of so many samples.
    const osg::StateSet* getComposite(float languageVersion, int samples, bool isPaged);

    void releaseGLObjects(osg::State* state);

private:
    using Key = std::tuple<int, int, bool>;
    std::mutex _mutex;
    std::map<Key, osg::ref_ptr<osg::StateSet>> _composites;
};

} // namespace osgLabels
