// SPDX-License-Identifier: MIT
#include "Inventor.h"

#include <osgLabels/UnitMesh.h>

#include <cctype>
#include <cmath>
#include <cstdio>
#include <ostream>

using namespace osgLabels;

namespace
{

// At their own size: OSG does not normalize normals below a scale.
constexpr int Sides = 12;

std::string numbers(std::initializer_list<double> values)
{
    std::string text;
    for (double value : values)
    {
        char number[32];
        std::snprintf(number, sizeof number, "%.7g", value);
        text += (text.empty() ? "" : " ") + std::string(number);
    }
    return text;
}

/// Inventor's shapes: its cylinder lies along y.
bool isBuiltIn(Shape shape)
{
    return shape == Shape::Box || shape == Shape::Extrusion || shape == Shape::Cylinder ||
           shape == Shape::Sphere;
}

} // namespace

std::string legalDefName(const std::string& name)
{
    std::string legal;
    for (char c : name)
    {
        if (c == '"')
            legal += "in";
        else if (static_cast<unsigned char>(c) <= ' ' || c == '\x7f' ||
                 std::string("'+.\\{}").find(c) != std::string::npos)
            legal += '_';
        else
            legal += c;
    }
    if (legal.empty() || !(std::isalpha(static_cast<unsigned char>(legal[0])) || legal[0] == '_'))
        legal = "_" + legal;
    return legal;
}

InventorWriter::InventorWriter(std::ostream& out) : _out(out)
{
    // Inventor has y up, and readers turn it.
    _out << "#Inventor V2.1 ascii\nSeparator {\n"
            "Rotation { rotation 1 0 0 -1.57079633 }\n"
            "ShapeHints { vertexOrdering COUNTERCLOCKWISE creaseAngle 0.6 }\n"
            // About as many sides as Sides, instead of 19.
            "Complexity { value 0.3 }\n";
}

InventorWriter::~InventorWriter()
{
    _out << "}\n";
}

void InventorWriter::add(const Primitive& primitive)
{
    osg::Quat rotation = primitive.rotation;
    if (primitive.shape == Shape::Cylinder)
        rotation = osg::Quat(0.5 * osg::PI, osg::Vec3d(1.0, 0.0, 0.0)) * rotation;
    double angle, x, y, z;
    rotation.getRotate(angle, x, y, z);
    if (x == 0.0 && y == 0.0 && z == 0.0)
        z = 1.0;
    const osg::Vec3d& at = primitive.position;
    if (!primitive.name.empty())
        _out << "DEF " << legalDefName(primitive.name) << " ";
    _out << "Separator {\nTransform { translation " << numbers({at.x(), at.y(), at.z()});
    if (angle != 0.0)
        _out << " rotation " << numbers({x, y, z, angle});
    const osg::Vec4ub& color = primitive.color;
    _out << " }\n";
    std::string material = "Material { diffuseColor " +
                           numbers({color.r() / 255.0, color.g() / 255.0, color.b() / 255.0});
    if (color.a() < 255)
        material += " transparency " + numbers({1.0 - color.a() / 255.0});
    material += " }\n";
    if (share(material))
        _out << material;
    writeShape(primitive);
    _out << "}\n";
}

void InventorWriter::writeShape(const Primitive& primitive)
{
    const osg::Vec3 size = primitive.size;
    if (primitive.shape == Shape::Cylinder)
        _out << "Cylinder { radius " << numbers({size.x()}) << " height "
             << numbers({2.0 * size.z()}) << " }\n";
    else if (primitive.shape == Shape::Sphere)
        _out << "Sphere { radius " << numbers({size.x()}) << " }\n";
    else if (isBuiltIn(primitive.shape))
        _out << "Cube { width " << numbers({2.0 * size.x()}) << " height "
             << numbers({2.0 * size.y()}) << " depth " << numbers({2.0 * size.z()}) << " }\n";
    else
    {
        const std::string key = std::to_string(unsigned(primitive.shape)) + " " +
                                numbers({size.x(), size.y(), size.z()});
        writeMesh(primitive, key);
    }
}

bool InventorWriter::share(const std::string& key)
{
    const auto [found, isNew] = _shared.try_emplace(key, int(_shared.size()));
    _out << (isNew ? "DEF +" : "USE +") << found->second << (isNew ? " " : "\n");
    return isNew;
}

void InventorWriter::writeMesh(const Primitive& primitive, const std::string& key)
{
    if (!share(key))
        return;
    const osg::Vec3& size = primitive.size;
    ObjectRecord record;
    record.shape = std::uint32_t(primitive.shape);
    record.size = glm::vec3(size.x(), size.y(), size.z());
    const UnitMesh mesh = makeUnitMesh(kindOf(record), Sides);
    std::string points, normals;
    for (const SurfacePoint& unit : mesh.points)
    {
        const SurfacePoint p = placePoint(record, unit);
        points += numbers({p.position.x, p.position.y, p.position.z}) + ",\n";
        normals += numbers({p.normal.x, p.normal.y, p.normal.z}) + ",\n";
    }
    _out << "IndexedFaceSet { vertexProperty VertexProperty {\nvertex [\n"
         << points << "]\nnormal [\n"
         << normals << "]\nnormalBinding PER_VERTEX_INDEXED }\ncoordIndex [\n";
    for (std::size_t i = 0; i < mesh.triangles.size(); i += 3)
        _out << mesh.triangles[i] << ", " << mesh.triangles[i + 1] << ", " << mesh.triangles[i + 2]
             << ", -1,\n";
    _out << "] }\n";
}
