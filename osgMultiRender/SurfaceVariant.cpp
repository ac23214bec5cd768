// SPDX-License-Identifier: MIT
#include <osgMultiRender/SurfaceVariant.h>

#include <osgMultiRender/ProgramWrap.h>
#include <osgMultiRender/SurfaceSource.h>

#include <osg/ContextData>
#include <osg/GLObjects>
#include <osg/Shader>
#include <osg/State>
#include <osg/Uniform>

namespace osgMultiRender
{

namespace
{

std::string mainOf(const SurfaceSnippet& snippet)
{
    return "layout(location = 0) out vec4 osgmr_out0;\n" + snippet.fragment + snippet.output +
           "void main()\n{\n    osgmr_out0 = " +
           (snippet.output.empty() ? "osgmr_surface()" : "osgmr_output(osgmr_surface())") + ";\n" +
           snippet.statements + "}\n";
}

} // namespace

SurfaceSnippet& SurfaceSnippet::operator+=(const SurfaceSnippet& other)
{
    fragment += other.fragment;
    output += other.output;
    vertex += other.vertex;
    vertexStatements += other.vertexStatements;
    statements += other.statements;
    samplers.insert(samplers.end(), other.samplers.begin(), other.samplers.end());
    attributes.insert(attributes.end(), other.attributes.begin(), other.attributes.end());
    return *this;
}

SurfaceVariant::SurfaceVariant(const SurfaceKey& key, const SurfaceSnippet& snippet,
                               const std::string& instance, float languageVersion)
    : osg::Referenced(true), _key(key), _program(new osg::Program), _stateSet(new osg::StateSet)
{
    const std::string version = glslVersionLine(languageVersion);
    const SurfaceSource source =
        makeSurfaceSource(key, {instance, snippet.vertex, snippet.vertexStatements});
    const std::string name = toString(key);
    osg::ref_ptr<osg::Shader> vertex =
        new osg::Shader(osg::Shader::VERTEX, version + source.vertex);
    osg::ref_ptr<osg::Shader> fragment =
        new osg::Shader(osg::Shader::FRAGMENT, version + source.fragment + mainOf(snippet));
    vertex->setName("osgMultiRender vertex, " + name);
    fragment->setName("osgMultiRender fragment, " + name);
    _program->setName("osgMultiRender " + name);
    _program->addShader(vertex);
    _program->addShader(fragment);
    finish(snippet);
    // The fixed function ignores these modes, a program does not.
    const bool twoSided = key.twoSided && key.lighting == LightingMode::Vertex;
    _stateSet->setMode(GL_VERTEX_PROGRAM_TWO_SIDE,
                       (twoSided ? osg::StateAttribute::ON : osg::StateAttribute::OFF) |
                           osg::StateAttribute::OVERRIDE);
    _stateSet->setMode(GL_VERTEX_PROGRAM_POINT_SIZE,
                       osg::StateAttribute::OFF | osg::StateAttribute::OVERRIDE);
    for (unsigned int unit = 0; unit < key.textures.size(); ++unit)
        if (key.textures[unit].target)
            _stateSet->addUniform(new osg::Uniform(("osgmr_texture" + std::to_string(unit)).c_str(),
                                                   static_cast<int>(unit)));
}

SurfaceVariant::SurfaceVariant(const SurfaceKey& key, const SurfaceSnippet& snippet,
                               const osg::Program& program)
    : osg::Referenced(true), _key(key), _stateSet(new osg::StateSet)
{
    _program = wrapProgram(program, {snippet.fragment, snippet.statements}, _error);
    if (_program)
        finish(snippet);
}

SurfaceVariant::SurfaceVariant(const SurfaceKey& key, const SurfaceSnippet& snippet,
                               const SurfaceLook& look)
    : osg::Referenced(true), _key(key), _look(&look), _stateSet(new osg::StateSet)
{
    if (snippet.fragment.empty() && snippet.statements.empty())
        _program = const_cast<osg::Program*>(look.getProgram());
    else
        _program =
            wrapProgram(*look.getProgram(), {snippet.fragment, snippet.statements}, _error, true);
    if (!_program)
        return;
    _stateSet->merge(*look.getStateSet());
    finish(snippet);
}

void SurfaceVariant::finish(const SurfaceSnippet& snippet)
{
    for (const auto& [sampler, unit] : snippet.samplers)
        _stateSet->addUniform(new osg::Uniform(sampler.c_str(), unit));
    for (const auto& [name, location] : snippet.attributes)
        _program->addBindAttribLocation(name, location);
    // Several graphics contexts draw it, each in a thread of its own.
    _program->setThreadSafeRefUnref(true);
    _stateSet->setThreadSafeRefUnref(true);
    _stateSet->setAttributeAndModes(_program,
                                    osg::StateAttribute::ON | osg::StateAttribute::OVERRIDE);
}

SurfaceLook::SurfaceLook(osg::Program* program, osg::StateSet* stateSet)
    : osg::Referenced(true), _program(program), _stateSet(stateSet), _content(contentOf(*program))
{
    _program->setThreadSafeRefUnref(true);
    _stateSet->setThreadSafeRefUnref(true);
}

void SurfaceLook::resizeGLObjectBuffers(unsigned int maxSize)
{
    std::lock_guard<std::mutex> lock(_mutex);
    _program->resizeGLObjectBuffers(maxSize);
    _stateSet->resizeGLObjectBuffers(maxSize);
    for (auto& [kit, variants] : _variants)
        for (auto& [key, variant] : variants)
            if (variant->getProgram())
                const_cast<osg::Program*>(variant->getProgram())->resizeGLObjectBuffers(maxSize);
}

void SurfaceLook::releaseGLObjects(osg::State* state) const
{
    std::lock_guard<std::mutex> lock(_mutex);
    _program->releaseGLObjects(state);
    _stateSet->releaseGLObjects(state);
    for (const auto& [kit, variants] : _variants)
        for (const auto& [key, variant] : variants)
            if (variant->getProgram())
                variant->getProgram()->releaseGLObjects(state);
}

namespace
{

/// Releases what the cache has in a context that is closed.
class ClosingContext : public osg::GraphicsObjectManager
{
public:
    explicit ClosingContext(unsigned int contextID)
        : osg::GraphicsObjectManager("osgMultiRender::SurfaceVariantCache", contextID)
    {
    }
    void flushDeletedGLObjects(double, double&) override {}
    void flushAllDeletedGLObjects() override {}
    void deleteAllGLObjects() override { release(); }
    void discardAllGLObjects() override { release(); }

private:
    void release() const
    {
        osg::ref_ptr<osg::State> number = new osg::State; // says which context, nothing else
        number->setContextID(_contextID);
        SurfaceVariantCache::instance().releaseGLObjects(number);
    }
};

} // namespace

SurfaceVariantCache& SurfaceVariantCache::instance()
{
    static SurfaceVariantCache cache;
    return cache;
}

void SurfaceVariantCache::attach(unsigned int contextID)
{
    osg::get<ClosingContext>(contextID);
}

void SurfaceVariantCache::resizeGLObjectBuffers(unsigned int maxSize)
{
    std::lock_guard<std::mutex> lock(_mutex);
    for (auto& [kit, variants] : _variants)
        for (auto& [key, variant] : variants)
            if (variant->getProgram())
                const_cast<osg::Program*>(variant->getProgram())->resizeGLObjectBuffers(maxSize);
}

void SurfaceVariantCache::releaseGLObjects(osg::State* state) const
{
    std::lock_guard<std::mutex> lock(_mutex);
    for (const auto& [kit, variants] : _variants)
        for (const auto& [key, variant] : variants)
            if (variant->getProgram())
                variant->getProgram()->releaseGLObjects(state);
}

} // namespace osgMultiRender
