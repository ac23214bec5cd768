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
    /// Declares osgLabels_writeSurface(): the first pass.
    static std::string surface();
    /// Declares osgLabels_locate(): where on its label a pixel lies. `defines` come first: see
    /// LabelResources::getDefines().
    static std::string locate(const std::string& defines);
    /// Declares osgLabels_direct(): the colour of a surface that is drawn in the view.
    static std::string direct();
    /// Declares osgLabels_over(): the colour of a surface with its label.
    static std::string ink();
    /// Declares the label table and osgLabels_inkAndOutline().
    static std::string text(const std::string& defines);
    /// Text of a shader file: found on OSG_FILE_PATH, else the built-in one.
    static std::string file(osg::Shader::Type type, const std::string& name, const char* builtIn);
};

/// The programs of the second pass. Thread safe.
class LabelPrograms
{
public:
    /// Program and state of the pass, with OVERRIDE, for targets of so many samples.
    const osg::StateSet* getComposite(float languageVersion, int samples,
                                      const std::string& defines);

    void releaseGLObjects(osg::State* state);

private:
    using Key = std::tuple<int, int, std::string>;
    std::mutex _mutex;
    std::map<Key, osg::ref_ptr<osg::StateSet>> _composites;
};

} // namespace osgLabels
