// SPDX-License-Identifier: MIT
#pragma once

#include <osgMultiRender/Export.h>
#include <osgMultiRender/SurfaceKey.h>

#include <osg/Program>
#include <osg/StateSet>

#include <atomic>
#include <mutex>
#include <string>
#include <unordered_map>

namespace osgMultiRender
{

/// What a kit adds to the surface functions of a variant.
struct SurfaceSnippet
{
    std::string fragment; ///< GLSL after the surface function; may define osgmr_addLights().
    std::vector<std::pair<std::string, int>> samplers; ///< Uniform name and texture unit.
};

/// A program for all surfaces with one key, and the StateSet that puts it over a leaf's own state.
class OSGMULTIRENDER_EXPORT SurfaceVariant : public osg::Referenced
{
public:
    SurfaceVariant(const SurfaceKey& key, const SurfaceSnippet& snippet, float languageVersion);

    const SurfaceKey& getKey() const { return _key; }
    const osg::StateSet* getStateSet() const { return _stateSet.get(); }
    const osg::Program* getProgram() const { return _program.get(); }

    /// Set by the draw thread when the program did not link; its leaves then show the fixed function.
    std::atomic<bool> failed{false};
    /// Milliseconds of the first application, which compiles and links; 0 before it.
    std::atomic<double> compileMilliseconds{0.0};

protected:
    ~SurfaceVariant() override = default;

private:
    SurfaceKey _key;
    osg::ref_ptr<osg::Program> _program;
    osg::ref_ptr<osg::StateSet> _stateSet;
};

/// The programs of all kits in the process. Thread safe.
class OSGMULTIRENDER_EXPORT SurfaceVariantCache
{
public:
    static SurfaceVariantCache& instance();

    /// The variant of a key, made when it is new; `made` tells. `kit` names whose snippets the key's
    /// kit bits speak of.
    template <class MakeSnippet>
    osg::ref_ptr<SurfaceVariant> get(const std::string& kit, const SurfaceKey& key,
                                     float languageVersion, MakeSnippet makeSnippet, bool& made)
    {
        std::lock_guard<std::mutex> lock(_mutex);
        osg::ref_ptr<SurfaceVariant>& variant = _variants[kit][key];
        made = !variant;
        if (made)
            variant = new SurfaceVariant(key, makeSnippet(), languageVersion);
        return variant;
    }

    void resizeGLObjectBuffers(unsigned int maxSize);
    void releaseGLObjects(osg::State* state) const;

private:
    SurfaceVariantCache() = default;

    mutable std::mutex _mutex;
    std::unordered_map<
        std::string, std::unordered_map<SurfaceKey, osg::ref_ptr<SurfaceVariant>, SurfaceKeyHash>>
        _variants;
};

} // namespace osgMultiRender
