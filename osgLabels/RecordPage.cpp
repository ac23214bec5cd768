// SPDX-License-Identifier: MIT
#include <osgLabels/RecordPage.h>

#include <osgLabels/LabelUnits.h>
#include <osgLabels/Shaders.h>
#include <osgMultiRender/VertexSnippet.h>

#include <osg/BlendFunc>
#include <osg/Depth>
#include <osg/Material>
#include <osg/TextureBuffer>
#include <osg/Uniform>
#include <osg/observer_ptr>
#include <osgDB/ReadFile>

#include <mutex>

namespace osgLabels
{

namespace
{

std::string shaderText(osg::Shader::Type type, const char* file, const char* fallback)
{
    const osg::ref_ptr<osg::Shader> shader =
        osgDB::readRefShaderFileWithFallback(type, file, fallback);
    return shader ? shader->getShaderSource() : std::string(fallback);
}

osg::ref_ptr<osg::Program> makeProgram()
{
    const std::string version = "#version 330 compatibility\n";
    const std::string instance =
        shaderText(osg::Shader::VERTEX, "osgLabels/instance.vert", shaders::instance_vert);
    osg::ref_ptr<osg::Program> program = new osgMultiRender::VertexSnippet(instance);
    program->setName("osgLabels::PrimitiveBatch");
    program->addShader(new osg::Shader(
        osg::Shader::VERTEX,
        version + instance +
            shaderText(osg::Shader::VERTEX, "osgLabels/primitive.vert", shaders::primitive_vert)));
    program->addShader(
        new osg::Shader(osg::Shader::FRAGMENT,
                        version + shaderText(osg::Shader::FRAGMENT, "osgLabels/primitive.frag",
                                             shaders::primitive_frag)));
    program->setThreadSafeRefUnref(true);
    return program;
}

/// What all pages of all batches have in common, as long as there is one.
osg::ref_ptr<osg::Program> sharedProgram()
{
    static std::mutex mutex;
    static osg::observer_ptr<osg::Program> shared;
    const std::lock_guard<std::mutex> lock(mutex);
    osg::ref_ptr<osg::Program> program;
    if (!shared.lock(program))
        shared = program = makeProgram();
    return program;
}

osg::ref_ptr<osg::TextureBuffer> bufferOf(osg::Array& array, GLenum format)
{
    osg::ref_ptr<osg::VertexBufferObject> buffer = new osg::VertexBufferObject;
    buffer->setUsage(GL_STATIC_DRAW);
    array.setBufferObject(buffer);
    osg::ref_ptr<osg::TextureBuffer> texture = new osg::TextureBuffer(&array);
    texture->setInternalFormat(GLint(format));
    return texture;
}

} // namespace

RecordPage::RecordPage(unsigned int objects)
    : osg::Referenced(true), _records(new osg::UIntArray(ObjectRecord::Words * objects)),
      _colors(new osg::Vec4ubArray(objects))
{
    makeStateSets();
}

RecordPage::RecordPage(osg::UIntArray* records, osg::Vec4ubArray* colors)
    : osg::Referenced(true), _records(records), _colors(colors)
{
    makeStateSets();
}

ObjectRecord RecordPage::getRecord(unsigned int i) const
{
    ObjectRecord record;
    const unsigned int* words = &(*_records)[ObjectRecord::Words * i];
    float first[7];
    std::memcpy(first, words, sizeof first);
    record.rotation = glm::quat(first[3], first[0], first[1], first[2]);
    record.origin = glm::vec3(first[4], first[5], first[6]);
    record.shape = words[7];
    std::memcpy(&record.size[0], words + 8, 3 * sizeof(float));
    record.identifier = words[11];
    return record;
}

void RecordPage::setRecord(unsigned int i, const ObjectRecord& record)
{
    const auto words = record.pack();
    std::copy(words.begin(), words.end(), _records->begin() + ObjectRecord::Words * i);
    _records->dirty();
}

void RecordPage::setColor(unsigned int i, const osg::Vec4ub& color)
{
    (*_colors)[i] = color;
    _colors->dirty();
}

void RecordPage::resizeGLObjectBuffers(unsigned int maxSize)
{
    _records->resizeGLObjectBuffers(maxSize);
    _colors->resizeGLObjectBuffers(maxSize);
}

void RecordPage::releaseGLObjects(osg::State* state) const
{
    _records->releaseGLObjects(state);
    _colors->releaseGLObjects(state);
}

void RecordPage::makeStateSets()
{
    constexpr GLenum rgba32ui = 0x8D70, rgba8 = 0x8058;
    const osg::ref_ptr<osg::TextureBuffer> records = bufferOf(*_records, rgba32ui);
    const osg::ref_ptr<osg::TextureBuffer> colors = bufferOf(*_colors, rgba8);
    const osg::ref_ptr<osg::Program> program = sharedProgram();
    osg::ref_ptr<osg::Material> material = new osg::Material;
    material->setColorMode(osg::Material::AMBIENT_AND_DIFFUSE);
    for (osg::ref_ptr<osg::StateSet>& stateSet : _stateSets)
    {
        stateSet = new osg::StateSet;
        stateSet->setTextureAttribute(RecordsUnit, records);
        stateSet->setTextureAttribute(ColorsUnit, colors);
        stateSet->setAttribute(program);
        stateSet->setAttribute(material);
        stateSet->addUniform(new osg::Uniform("osgLabels_records", int(RecordsUnit)));
        stateSet->addUniform(new osg::Uniform("osgLabels_colors", int(ColorsUnit)));
    }
    _stateSets[1]->setAttributeAndModes(new osg::BlendFunc);
    _stateSets[1]->setRenderingHint(osg::StateSet::TRANSPARENT_BIN);
}

} // namespace osgLabels
