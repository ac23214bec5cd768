// SPDX-License-Identifier: MIT
#include "Drawables.h"

#include <osgLabels/UnitMesh.h>

#include <osg/Geode>
#include <osg/Geometry>
#include <osg/Material>
#include <osg/Texture2D>
#include <osgText/Font>
#include <osgText/Text>

#include <algorithm>
#include <cstring>
#include <map>

using namespace osgLabels;

namespace
{

ObjectRecord recordOf(const Primitive& primitive)
{
    const osg::Quat q = primitive.rotation.inverse();
    ObjectRecord record;
    record.rotation = glm::quat(float(q.w()), float(q.x()), float(q.y()), float(q.z()));
    record.origin =
        glm::vec3(primitive.position.x(), primitive.position.y(), primitive.position.z());
    record.shape = std::uint32_t(primitive.shape);
    record.size = glm::vec3(primitive.size.x(), primitive.size.y(), primitive.size.z());
    return record;
}

const UnitMesh& meshOf(const ObjectRecord& record)
{
    static std::map<std::uint32_t, UnitMesh> meshes;
    const MeshKind kind = kindOf(record);
    const auto [found, isNew] = meshes.try_emplace(kind.number());
    if (isNew)
        found->second = makeUnitMesh(kind, LevelSides[VisitorLevel]);
    return found->second;
}

osg::ref_ptr<osg::Geometry> geometryOf(const Primitive& primitive)
{
    const ObjectRecord record = recordOf(primitive);
    const UnitMesh& mesh = meshOf(record);
    osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array, normals = new osg::Vec3Array;
    for (const SurfacePoint& unit : mesh.points)
    {
        const SurfacePoint point = placePoint(record, unit);
        vertices->push_back({point.position.x, point.position.y, point.position.z});
        normals->push_back({point.normal.x, point.normal.y, point.normal.z});
    }
    osg::ref_ptr<osg::Vec4ubArray> colors = new osg::Vec4ubArray(1, &primitive.color);
    colors->setNormalize(true);
    osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
    geometry->setVertexArray(vertices);
    geometry->setNormalArray(normals, osg::Array::BIND_PER_VERTEX);
    geometry->setColorArray(colors, osg::Array::BIND_OVERALL);
    geometry->addPrimitiveSet(new osg::DrawElementsUShort(
        GL_TRIANGLES, unsigned(mesh.triangles.size()), mesh.triangles.data()));
    geometry->setUseDisplayList(false);
    geometry->setUseVertexBufferObjects(true);
    return geometry;
}

osg::ref_ptr<osgText::Text> textOf(const Primitive& primitive, const osg::BoundingBox& box)
{
    osg::ref_ptr<osgText::Text> text = new osgText::Text;
    const float size = std::max(box.xMax() - box.xMin(), box.zMax() - box.zMin());
    text->setText(primitive.name, osgText::String::ENCODING_UTF8);
    text->setAxisAlignment(osgText::Text::XZ_PLANE);
    text->setAlignment(osgText::Text::CENTER_CENTER);
    text->setCharacterSize(1.5f * size / float(std::max<std::size_t>(primitive.name.size(), 4)));
    text->setPosition({box.center().x(), box.yMin() - 0.01f, box.center().z()});
    return text;
}

/// The name in black on white.
osg::ref_ptr<osg::Image> imageOf(const std::string& name)
{
    constexpr int height = 32;
    const osg::ref_ptr<osgText::Font> font = osgText::Font::getDefaultFont();
    std::vector<const osg::Image*> glyphs;
    int width = 8;
    for (char letter : name)
    {
        glyphs.push_back(font->getGlyph({20, 20}, static_cast<unsigned char>(letter)));
        width += glyphs.back() ? glyphs.back()->s() : 0;
    }
    osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(width, height, 1, GL_LUMINANCE, GL_UNSIGNED_BYTE);
    std::memset(image->data(), 255, image->getTotalSizeInBytes());
    int x = 4;
    for (const osg::Image* glyph : glyphs)
    {
        for (int t = 0; glyph && t < std::min(glyph->t(), height); ++t)
            for (int s = 0; s < glyph->s(); ++s)
                *image->data(x + s, t) = static_cast<unsigned char>(255 - *glyph->data(s, t));
        x += glyph ? glyph->s() : 0;
    }
    return image;
}

void addTexture(const Primitive& primitive, osg::Geometry& geometry)
{
    osg::ref_ptr<osg::Vec2Array> coords = new osg::Vec2Array;
    for (const SurfacePoint& unit : meshOf(recordOf(primitive)).points)
        coords->push_back({0.5f + 0.5f * unit.position.x, 0.5f + 0.5f * unit.position.z});
    geometry.setTexCoordArray(0, coords);
    osg::ref_ptr<osg::Texture2D> texture = new osg::Texture2D(imageOf(primitive.name));
    texture->setResizeNonPowerOfTwoHint(false);
    texture->setWrap(osg::Texture::WRAP_S, osg::Texture::REPEAT);
    texture->setWrap(osg::Texture::WRAP_T, osg::Texture::REPEAT);
    geometry.getOrCreateStateSet()->setTextureAttributeAndModes(0, texture);
}

} // namespace

Drawables::Drawables(DrawableLabels labels) : _root(new osg::Group), _labels(labels)
{
    osg::ref_ptr<osg::Material> material = new osg::Material;
    material->setColorMode(osg::Material::AMBIENT_AND_DIFFUSE);
    _root->getOrCreateStateSet()->setAttribute(material);
}

void Drawables::add(const Primitive& primitive)
{
    osg::ref_ptr<osg::Geode> geode = new osg::Geode;
    geode->setName(primitive.name);
    const osg::ref_ptr<osg::Geometry> geometry = geometryOf(primitive);
    geode->addDrawable(geometry);
    if (_labels == DrawableLabels::Text)
        geode->addDrawable(textOf(primitive, geometry->getBoundingBox()));
    if (_labels == DrawableLabels::Texture)
        addTexture(primitive, *geometry);
    _root->addChild(geode);
}
