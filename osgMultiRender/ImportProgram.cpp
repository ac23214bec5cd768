// SPDX-License-Identifier: MIT
#include <osgMultiRender/ImportProgram.h>

#include <osg/Drawable>
#include <osg/NodeVisitor>

#include <algorithm>

namespace osgMultiRender
{

namespace
{

/// False for compute shaders and unknown ones.
bool stageOf(const osg::Shader& shader, GlslStage& stage)
{
    switch (shader.getType())
    {
    case osg::Shader::VERTEX:
        stage = GlslStage::Vertex;
        return true;
    case osg::Shader::FRAGMENT:
        stage = GlslStage::Fragment;
        return true;
    case osg::Shader::GEOMETRY:
        stage = GlslStage::Geometry;
        return true;
    case osg::Shader::TESSCONTROL:
        stage = GlslStage::TessellationControl;
        return true;
    case osg::Shader::TESSEVALUATION:
        stage = GlslStage::TessellationEvaluation;
        return true;
    default:
        return false;
    }
}

std::vector<double> valuesOf(const osg::Uniform& uniform)
{
    std::vector<double> values;
    const auto add = [&values](const auto* array)
    {
        const auto count = array ? array->getNumElements() * unsigned(array->getDataSize()) : 0u;
        for (unsigned int i = 0; i < count; ++i)
        {
            const auto* data = &(*array)[0];
            values.push_back(static_cast<double>(data[i]));
        }
    };
    add(uniform.getFloatArray());
    add(uniform.getDoubleArray());
    add(uniform.getIntArray());
    add(uniform.getUIntArray());
    return values;
}

class ProgramFinder : public osg::NodeVisitor
{
public:
    ProgramFinder() : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN) {}

    void apply(osg::Node& node) override
    {
        if (const osg::StateSet* stateSet = node.getStateSet())
        {
            add(*stateSet);
        }
        traverse(node);
    }

    std::vector<Rendering> found;

private:
    void add(const osg::StateSet& stateSet)
    {
        const auto* program =
            dynamic_cast<const osg::Program*>(stateSet.getAttribute(osg::StateAttribute::PROGRAM));
        const bool known = std::find(_known.begin(), _known.end(), program) != _known.end();
        if (program && !known && !program->isFixedFunction())
        {
            _known.push_back(program);
            found.push_back(importProgram(*program, &stateSet));
        }
    }

    std::vector<const osg::Program*> _known;
};

} // namespace

Rendering importProgram(const osg::Program& program, const osg::StateSet* stateSet)
{
    Rendering rendering;
    rendering.name = program.getName().empty() ? "program" : program.getName();
    for (unsigned int i = 0; i < program.getNumShaders(); ++i)
    {
        const osg::Shader& source = *program.getShader(i);
        RenderingShader shader;
        if (!stageOf(source, shader.stage))
        {
            rendering.messages.push_back(
                {true, rendering.name + ": it has a shader that is of no drawing stage"});
            continue;
        }
        shader.text = source.getShaderSource();
        shader.fileName = source.getFileName().empty() ? source.getName() : source.getFileName();
        rendering.shaders.push_back(std::move(shader));
    }
    for (const auto& [name, location] : program.getAttribBindingList())
    {
        rendering.attributeBindings[name] = location;
    }
    for (const auto& [name, location] : program.getFragDataBindingList())
    {
        rendering.fragmentDataBindings[name] = location;
    }
    if (!stateSet)
    {
        return rendering;
    }
    for (const auto& [name, held] : stateSet->getUniformList())
    {
        RenderingUniform uniform;
        uniform.name = name;
        uniform.type = osg::Uniform::getTypename(held.first->getType());
        uniform.arraySize = static_cast<int>(held.first->getNumElements());
        uniform.values = valuesOf(*held.first);
        rendering.uniforms.push_back(std::move(uniform));
    }
    for (unsigned int i = 0; i < program.getNumShaders(); ++i)
    {
        // OSG defines what a shader asks for by #pragma import_defines, and no more.
        const auto& asked = const_cast<osg::Shader*>(program.getShader(i))->getShaderDefines();
        for (const auto& [name, held] : stateSet->getDefineList())
        {
            if (asked.count(name) && (held.second & osg::StateAttribute::ON))
            {
                rendering.defines[name] = held.first;
            }
        }
    }
    return rendering;
}

std::vector<Rendering> importPrograms(osg::Node& node)
{
    ProgramFinder finder;
    node.accept(finder);
    return std::move(finder.found);
}

} // namespace osgMultiRender
