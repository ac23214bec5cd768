// SPDX-License-Identifier: MIT
#include <osgMultiRender/ProgramWrap.h>

#include <osgMultiRender/GlslWrap.h>

#include <osg/DisplaySettings>
#include <osg/Shader>

#include <cctype>
#include <functional>
#include <regex>
#include <sstream>

namespace osgMultiRender
{

namespace
{

constexpr GLenum geometryParameters[] = {GL_GEOMETRY_VERTICES_OUT_EXT, GL_GEOMETRY_INPUT_TYPE_EXT,
                                         GL_GEOMETRY_OUTPUT_TYPE_EXT};

bool stageOf(osg::Shader::Type type, GlslStage& stage)
{
    switch (type)
    {
    case osg::Shader::VERTEX:
        stage = GlslStage::Vertex;
        return true;
    case osg::Shader::TESSCONTROL:
        stage = GlslStage::TessellationControl;
        return true;
    case osg::Shader::TESSEVALUATION:
        stage = GlslStage::TessellationEvaluation;
        return true;
    case osg::Shader::GEOMETRY:
        stage = GlslStage::Geometry;
        return true;
    case osg::Shader::FRAGMENT:
        stage = GlslStage::Fragment;
        return true;
    default:
        return false;
    }
}

std::string nameOf(const osg::Shader& shader)
{
    if (!shader.getFileName().empty())
        return shader.getFileName();
    return shader.getName().empty() ? std::string(shader.getTypename()) + " shader"
                                    : shader.getName();
}

std::string messageOf(const osg::Program& program, const GlslWrapMessage& message)
{
    std::string text = message.where.message;
    if (message.shader < program.getNumShaders())
        text = nameOf(*program.getShader(message.shader)) + ":" +
               std::to_string(message.where.line) + ": " + text;
    return text;
}

/// "$OSG_GLSL_VERSION" and the like, which osg::State replaces only when it compiles.
std::string withVariables(const std::string& text)
{
    std::string result;
    for (std::size_t i = 0; i < text.size();)
    {
        std::size_t end = i + 1;
        while (text[i] == '$' && end < text.size() &&
               (std::isalnum(static_cast<unsigned char>(text[end])) || text[end] == '_'))
            ++end;
        if (end == i + 1)
            result += text[i];
        else
        {
            std::string value;
            osg::DisplaySettings::instance()->getValue(text.substr(i + 1, end - i - 1), value);
            result += value;
        }
        i = end;
    }
    return result;
}

void copySettings(const osg::Program& from, osg::Program& to)
{
    to.setName(from.getName());
    for (const auto& [name, index] : from.getAttribBindingList())
        to.addBindAttribLocation(name, index);
    for (const auto& [name, index] : from.getUniformBlockBindingList())
        to.addBindUniformBlock(name, index);
    for (GLenum parameter : geometryParameters)
        to.setParameter(parameter, from.getParameter(parameter));
    for (unsigned int i = 0; i < from.getNumTransformFeedBackVaryings(); ++i)
        to.addTransformFeedBackVarying(from.getTransformFeedBackVarying(i));
    to.setTransformFeedBackMode(from.getTransformFeedBackMode());
    to.setShaderDefines(from.getShaderDefines());
}

} // namespace

std::uint64_t contentOf(const osg::Program& program)
{
    std::uint64_t hash = 1469598103934665603ull; // FNV-1a
    const auto add = [&hash](std::uint64_t x) { hash = (hash ^ x) * 1099511628211ull; };
    const auto addText = [&add](const std::string& text) { add(std::hash<std::string>()(text)); };
    const auto addBindings = [&](const auto& bindings)
    {
        for (const auto& [name, index] : bindings)
        {
            addText(name);
            add(index);
        }
    };
    for (unsigned int i = 0; i < program.getNumShaders(); ++i)
    {
        add(program.getShader(i)->getType());
        addText(program.getShader(i)->getShaderSource());
    }
    addBindings(program.getAttribBindingList());
    addBindings(program.getFragDataBindingList());
    addBindings(program.getUniformBlockBindingList());
    for (GLenum parameter : geometryParameters)
        add(program.getParameter(parameter));
    for (unsigned int i = 0; i < program.getNumTransformFeedBackVaryings(); ++i)
        addText(program.getTransformFeedBackVarying(i));
    add(program.getTransformFeedBackMode());
    for (const std::string& define : program.getShaderDefines())
        addText(define);
    return hash ? hash : 1;
}

osg::ref_ptr<osg::Program> wrapProgram(const osg::Program& program, const GlslSnippet& snippet,
                                       std::string& error, bool isOurs)
{
    std::vector<GlslShader> shaders;
    for (unsigned int i = 0; i < program.getNumShaders(); ++i)
    {
        const osg::Shader& shader = *program.getShader(i);
        GlslShader text;
        if (!stageOf(shader.getType(), text.stage) || shader.getShaderSource().empty())
        {
            error = nameOf(shader) + " is no text of a stage that draws";
            return nullptr;
        }
        text.text = withVariables(shader.getShaderSource());
        shaders.push_back(std::move(text));
    }
    // No higher than our main needs: each version makes keywords of names that users have.
    GlslVersion target;
    target.number = 330;
    target.profile = GlslVersion::Profile::Compatibility;
    GlslWrapped wrapped = wrapProgram(shaders, target, isOurs);
    if (!wrapped.ok)
    {
        error =
            wrapped.errors.empty() ? "unknown cause" : messageOf(program, wrapped.errors.front());
        return nullptr;
    }
    if (!bindOutputs(wrapped.outputs, program.getFragDataBindingList(), error))
        return nullptr;

    osg::ref_ptr<osg::Program> result = new osg::Program;
    copySettings(program, *result);
    bool hasFragment = false;
    for (unsigned int i = 0; i < program.getNumShaders(); ++i)
    {
        const osg::Shader& original = *program.getShader(i);
        osg::ref_ptr<osg::Shader> shader = new osg::Shader(original.getType(), wrapped.texts[i]);
        shader->setName(original.getName());
        shader->setFileName(original.getFileName());
        result->addShader(shader);
        hasFragment = hasFragment || original.getType() == osg::Shader::FRAGMENT;
    }
    if (hasFragment) // without one the fixed function shades what the vertex stage gives
    {
        GlslMainOptions options;
        if (!snippet.statements.empty())
        {
            options.userLocations = 1; // those above are the snippet's
            options.snippets.push_back(snippet);
        }
        osg::ref_ptr<osg::Shader> main = new osg::Shader(
            osg::Shader::FRAGMENT, wrapperMain(wrapped.version, wrapped.outputs, options));
        main->setName("osgMultiRender main");
        result->addShader(main);
    }
    return result;
}

std::string errorsOf(const osg::Program& program, osg::State& state)
{
    // "0:12(5): error: …" (Mesa, Intel, AMD), "0(12) : error C1008: …" (NVIDIA)
    static const std::regex line(R"(^\d+[:(](\d+)\)?\s*(?:\(\d+\))?\s*:?\s*(.*)$)");
    std::ostringstream text;
    const auto report = [&text](const std::string& name, const std::string& log)
    {
        std::istringstream lines(log);
        for (std::string one; std::getline(lines, one);)
        {
            std::smatch match;
            if (one.find_first_not_of(" \t\r") == std::string::npos)
                continue;
            if (std::regex_match(one, match, line))
                text << name << ":" << match[1] << ": " << match[2] << "\n";
            else
                text << name << ": " << one << "\n";
        }
    };
    std::string log;
    for (unsigned int i = 0; i < program.getNumShaders(); ++i)
    {
        auto& shader = const_cast<osg::Shader&>(*program.getShader(i));
        auto* compiled = shader.getPCS(state);
        if (compiled && !compiled->isCompiled() && compiled->getInfoLog(log))
            report(nameOf(shader), log);
    }
    // One that was never applied has none yet.
    const osg::Program::PerContextProgram* linked = program.getPCP(state);
    if (text.str().empty() && linked && linked->getInfoLog(log))
        report(program.getName().empty() ? "program" : program.getName(), log);
    return text.str();
}

} // namespace osgMultiRender
