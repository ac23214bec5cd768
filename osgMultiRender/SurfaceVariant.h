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
    /// GLSL that defines vec4 osgmr_output(vec4 surface): what is written for a surface colour.
    /// Empty: the colour itself.
    std::string output;
    /// GLSL of the vertex stage, and statements of its main() after gl_Position. Not for surfaces
    /// with a program of their own.
    std::string vertex, vertexStatements;
    /// Statements of main() after the colour has been written to osgmr_out0.
    std::string statements;
    std::vector<std::pair<std::string, int>> samplers;            ///< Uniform and texture unit.
    std::vector<std::pair<std::string, unsigned int>> attributes; ///< Name and location.

    /// Joins what two kits add.
    SurfaceSnippet& operator+=(const SurfaceSnippet& other);
};

class SurfaceLook;

/// A program for all surfaces with one key, and the StateSet that puts it over a leaf's own state.
class OSGMULTIRENDER_EXPORT SurfaceVariant : public osg::Referenced
{
public:
    /// The surface function of the fixed-function state that the key says. `instance` is the GLSL
    /// of a VertexSnippet, or empty.
    SurfaceVariant(const SurfaceKey& key, const SurfaceSnippet& snippet,
                   const std::string& instance, float languageVersion);
    /// The surface function of a model's own Program; see getError(). Of the snippet it takes what
    /// comes after the colour.
    SurfaceVariant(const SurfaceKey& key, const SurfaceSnippet& snippet,
                   const osg::Program& program);

    const SurfaceKey& getKey() const { return _key; }
    const osg::StateSet* getStateSet() const { return _stateSet.get(); }
    /// Null for a Program that can't be wrapped.
    const osg::Program* getProgram() const { return _program.get(); }
    /// Why there is no Program.
    const std::string& getError() const { return _error; }

    /// A look, as it is where the snippet adds nothing.
    SurfaceVariant(const SurfaceKey& key, const SurfaceSnippet& snippet, const SurfaceLook& look);

    /// The look that it is of; null for others. To compare, not to use: it may be gone.
    const SurfaceLook* getLook() const { return _look; }

    /// Set by the draw thread when the program did not link; its leaves then show the fixed
    /// function.
    std::atomic<bool> failed{false};
    /// Milliseconds of the first application, which compiles and links; 0 before it.
    std::atomic<double> compileMilliseconds{0.0};

protected:
    ~SurfaceVariant() override = default;

private:
    void finish(const SurfaceSnippet& snippet);

    SurfaceKey _key;
    osg::ref_ptr<osg::Program> _program;
    const SurfaceLook* _look = nullptr;
    std::string _error;
    osg::ref_ptr<osg::StateSet> _stateSet;
};

/// What leaves look like instead of their own look: a complete program with the state it needs.
///
/// Keeps what variants are made of it, so that they live as long as it does. Thread safe.
class OSGMULTIRENDER_EXPORT SurfaceLook : public osg::Referenced
{
public:
    /// `program` is of GLSL 3.30 (compatibility) or more; `stateSet` has its uniforms and textures.
    /// Both may not be null.
    SurfaceLook(osg::Program* program, osg::StateSet* stateSet);

    const osg::Program* getProgram() const { return _program.get(); }
    const osg::StateSet* getStateSet() const { return _stateSet.get(); }
    std::uint64_t getContent() const { return _content; } ///< See contentOf().

    /// As SurfaceVariantCache::get().
    template <class Make>
    osg::ref_ptr<SurfaceVariant> get(const std::string& kit, const SurfaceKey& key, Make make,
                                     bool& made)
    {
        std::lock_guard<std::mutex> lock(_mutex);
        osg::ref_ptr<SurfaceVariant>& variant = _variants[kit][key];
        made = !variant;
        if (made)
            variant = make();
        return variant;
    }

    void resizeGLObjectBuffers(unsigned int maxSize);
    void releaseGLObjects(osg::State* state) const;

protected:
    ~SurfaceLook() override = default;

    osg::ref_ptr<osg::Program> _program;
    osg::ref_ptr<osg::StateSet> _stateSet;

private:
    std::uint64_t _content;
    mutable std::mutex _mutex;
    std::unordered_map<std::string,
                       std::unordered_map<SurfaceKey, osg::ref_ptr<SurfaceVariant>, SurfaceKeyHash>>
        _variants;
};

/// The programs of all kits in the process. Thread safe.
class OSGMULTIRENDER_EXPORT SurfaceVariantCache
{
public:
    static SurfaceVariantCache& instance();

    /// The variant of a key, which `make` makes when it is new; `made` tells. `kit` names whose
    /// snippets the key's kit bits speak of.
    template <class Make>
    osg::ref_ptr<SurfaceVariant> get(const std::string& kit, const SurfaceKey& key, Make make,
                                     bool& made)
    {
        std::lock_guard<std::mutex> lock(_mutex);
        osg::ref_ptr<SurfaceVariant>& variant = _variants[kit][key];
        made = !variant;
        if (made)
            variant = make();
        return variant;
    }

    /// The context draws with variants. They belong to no scene, so nobody else releases them when
    /// it is closed; the next one with its number would take its programs for its own.
    void attach(unsigned int contextID);
    void resizeGLObjectBuffers(unsigned int maxSize);
    void releaseGLObjects(osg::State* state) const;

private:
    SurfaceVariantCache() = default;

    mutable std::mutex _mutex;
    std::unordered_map<std::string,
                       std::unordered_map<SurfaceKey, osg::ref_ptr<SurfaceVariant>, SurfaceKeyHash>>
        _variants;
};

} // namespace osgMultiRender
