// SPDX-License-Identifier: MIT
#include "osgMultiRender/RenderingScenes.h"

#include <osg/Geode>
#include <osg/Geometry>
#include <osg/Group>
#include <osg/Light>
#include <osg/LightSource>
#include <osg/Material>
#include <osg/MatrixTransform>
#include <osg/Program>
#include <osg/Texture2D>

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <regex>
#include <sstream>

namespace
{

osg::ref_ptr<osg::Uniform> makeUniform(const std::string& type, const std::string& name,
                                       const std::string& value)
{
    std::istringstream stream(value);
    float v[3] = {0.0f, 0.0f, 0.0f};
    stream >> v[0] >> v[1] >> v[2];
    if (type == "int" || type == "sampler2D")
        return new osg::Uniform(name.c_str(), static_cast<int>(v[0]));
    if (type == "float")
        return new osg::Uniform(name.c_str(), v[0]);
    if (type == "vec2")
        return new osg::Uniform(name.c_str(), osg::Vec2(v[0], v[1]));
    if (type == "vec3")
        return new osg::Uniform(name.c_str(), osg::Vec3(v[0], v[1], v[2]));
    ADD_FAILURE() << "uniform " << name << " has the type " << type;
    return nullptr;
}

void addUniforms(osg::StateSet& stateSet, const std::string& text)
{
    const std::regex any("uniform +(\\w+) +(\\w+);([^\n]*)"),
        valued(" // = ([-0-9. ]+)( \\[[-0-9.]+, [-0-9.]+\\])?");
    for (auto at = std::sregex_iterator(text.begin(), text.end(), any);
         at != std::sregex_iterator(); ++at)
    {
        std::smatch value;
        const std::string comment = (*at)[3];
        if (std::regex_match(comment, value, valued))
            stateSet.addUniform(makeUniform((*at)[1], (*at)[2], value[1]));
        else
            ADD_FAILURE() << "uniform " << (*at)[2] << " has no value in its comment";
    }
}

/// A sheet of quads over 0 to 1 in u and v.
osg::ref_ptr<osg::Geometry> makeSheet(int steps,
                                      const std::function<osg::Vec3(float, float)>& point)
{
    const osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array, normals = new osg::Vec3Array;
    const osg::ref_ptr<osg::Vec2Array> places = new osg::Vec2Array;
    const float e = 1e-3f;
    for (int j = 0; j <= steps; ++j)
        for (int i = 0; i <= steps; ++i)
        {
            const float u = float(i) / steps, v = float(j) / steps;
            // Inside, so that poles have a normal, too.
            const float uu = std::min(std::max(u, e), 1 - e), vv = std::min(std::max(v, e), 1 - e);
            osg::Vec3 normal =
                (point(uu + e, vv) - point(uu - e, vv)) ^ (point(uu, vv + e) - point(uu, vv - e));
            normal.normalize();
            vertices->push_back(point(u, v));
            normals->push_back(normal);
            places->push_back({u, v});
        }
    const osg::ref_ptr<osg::DrawElementsUInt> faces = new osg::DrawElementsUInt(GL_TRIANGLES);
    for (int j = 0; j < steps; ++j)
        for (int i = 0; i < steps; ++i)
        {
            const auto a = static_cast<unsigned int>(j * (steps + 1) + i);
            const auto b = a + static_cast<unsigned int>(steps) + 1;
            for (const unsigned int index : {a, a + 1, b + 1, a, b + 1, b})
                faces->push_back(index);
        }
    const osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
    geometry->setVertexArray(vertices);
    geometry->setNormalArray(normals, osg::Array::BIND_PER_VERTEX);
    geometry->setTexCoordArray(0, places);
    const osg::ref_ptr<osg::Vec4Array> white = new osg::Vec4Array;
    white->push_back({1, 1, 1, 1});
    geometry->setColorArray(white, osg::Array::BIND_OVERALL);
    geometry->addPrimitiveSet(faces);
    return geometry;
}

osg::Vec3 onSphere(float u, float v)
{
    const float a = 6.2831853f * u, b = 3.1415927f * (v - 0.5f);
    return osg::Vec3(std::cos(a) * std::cos(b), std::sin(a) * std::cos(b), std::sin(b)) * 1.3f +
           osg::Vec3(-1.6f, 0.0f, 0.5f);
}

osg::Vec3 onWaves(float u, float v)
{
    return {6.0f * u - 3.0f, 5.0f * v - 2.5f,
            0.15f * std::sin(9.0f * u) * std::cos(7.0f * v) - 1.1f};
}

} // namespace

osg::ref_ptr<osg::StateSet> makeRenderingState(const osgMultiRender::BuiltInRendering& rendering)
{
    const osg::ref_ptr<osg::StateSet> stateSet = new osg::StateSet;
    const osg::ref_ptr<osg::Program> program = new osg::Program;
    program->setName(rendering.name);
    program->addShader(new osg::Shader(osg::Shader::VERTEX, rendering.vertex));
    program->addShader(new osg::Shader(osg::Shader::FRAGMENT, rendering.fragment));
    stateSet->setAttribute(program, osg::StateAttribute::OVERRIDE);
    addUniforms(*stateSet, rendering.vertex);
    addUniforms(*stateSet, rendering.fragment);
    return stateSet;
}

osg::ref_ptr<osg::Node> makeSampleModel(osg::Image& image)
{
    const osg::ref_ptr<osg::LightSource> root = new osg::LightSource;
    root->getLight()->setPosition({-0.4f, -0.7f, 0.9f, 0.0f});
    const osg::ref_ptr<osg::Geode> geode = new osg::Geode;
    geode->addDrawable(makeSheet(48, onSphere));
    geode->addDrawable(makeSheet(48, onWaves));
    for (int side = 0; side < 6; ++side)
    {
        const osg::Vec3 normals[] = {{1, 0, 0},  {-1, 0, 0}, {0, 1, 0},
                                     {0, -1, 0}, {0, 0, 1},  {0, 0, -1}};
        const osg::Vec3 n = normals[side], a(n.y(), n.z(), n.x()), b = n ^ a;
        geode->addDrawable(makeSheet(1,
                                     [=](float u, float v) {
                                         return osg::Vec3(1.5f, 0.0f, 0.1f) +
                                                (n + a * (2 * u - 1) + b * (2 * v - 1)) * 0.95f;
                                     }));
    }
    root->addChild(geode);
    osg::StateSet* const stateSet = root->getOrCreateStateSet();
    const osg::ref_ptr<osg::Material> material = new osg::Material;
    material->setDiffuse(osg::Material::FRONT_AND_BACK, {0.85f, 0.45f, 0.25f, 1.0f});
    material->setAmbient(osg::Material::FRONT_AND_BACK, {0.85f, 0.45f, 0.25f, 1.0f});
    material->setSpecular(osg::Material::FRONT_AND_BACK, {0.5f, 0.5f, 0.5f, 1.0f});
    material->setShininess(osg::Material::FRONT_AND_BACK, 30.0f);
    stateSet->setAttributeAndModes(material);
    stateSet->setTextureAttributeAndModes(0, new osg::Texture2D(&image));
    return root;
}

osg::ref_ptr<osg::Node> makeImageQuad(osg::Image& image)
{
    const osg::ref_ptr<osg::Geode> geode = new osg::Geode;
    geode->addDrawable(osg::createTexturedQuadGeometry({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}));
    const osg::ref_ptr<osg::Texture2D> texture = new osg::Texture2D(&image);
    texture->setFilter(osg::Texture::MIN_FILTER, osg::Texture::LINEAR);
    texture->setFilter(osg::Texture::MAG_FILTER, osg::Texture::LINEAR);
    texture->setWrap(osg::Texture::WRAP_S, osg::Texture::CLAMP_TO_EDGE);
    texture->setWrap(osg::Texture::WRAP_T, osg::Texture::CLAMP_TO_EDGE);
    geode->getOrCreateStateSet()->setTextureAttributeAndModes(0, texture);
    return geode;
}

osg::ref_ptr<osg::Image> makeSampleImage(int size)
{
    const osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(size, size, 1, GL_RGBA, GL_UNSIGNED_BYTE);
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x)
        {
            const float u = (x + 0.5f) / size, v = (y + 0.5f) / size;
            osg::Vec4 color(0.5f + 0.5f * std::sin(7.0f * u), v, 0.5f + 0.5f * std::cos(9.0f * v),
                            1.0f);
            if (std::hypot(u - 0.35f, v - 0.6f) < 0.2f)
                color = osg::Vec4(0.95f, 0.85f, 0.2f, 1.0f);
            if ((int(8 * u) + int(8 * v)) % 2 == 0 && u > 0.5f && v < 0.5f)
                color = osg::Vec4(0.1f, 0.15f, 0.4f, 1.0f);
            image->setColor(color, x, y);
        }
    return image;
}
