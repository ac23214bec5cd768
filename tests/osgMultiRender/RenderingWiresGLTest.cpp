// SPDX-License-Identifier: MIT
// Wires and drawn edges lie where OpenGL draws the lines of the same polygons.
#include "osgMultiRender/MixedPictures.h"

#include <osg/Geometry>
#include <osg/PolygonMode>
#include <osg/PolygonOffset>
#include <osg/Program>

using namespace osgMultiRender;

namespace
{

class RenderingWiresGLTest : public testing::Test
{
protected:
    static constexpr int Size = 256;

    void SetUp() override { OSGKITS_NEED_GL(_viewer); }

    static support::HeadlessSettings makeSettings()
    {
        support::HeadlessSettings settings;
        settings.width = settings.height = Size;
        return settings;
    }

    /// A cube of -1 to 1; each side of `parts` squares an axis.
    static osg::ref_ptr<osg::Geometry> makeCube(int parts)
    {
        osg::ref_ptr<osg::Geometry> cube = new osg::Geometry;
        osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array, normals = new osg::Vec3Array;
        for (int side = 0; side < 6; ++side)
        {
            const int axis = side / 2;
            osg::Vec3 normal, right, up;
            normal[axis] = side % 2 ? 1.0f : -1.0f;
            right[(axis + 1) % 3] = normal[axis];
            up[(axis + 2) % 3] = 1.0f;
            for (int y = 0; y < parts; ++y)
                for (int x = 0; x < parts; ++x)
                    for (const auto& [i, j] : {std::pair(0, 0), {1, 0}, {1, 1}, {0, 1}})
                    {
                        const float u = 2.0f * float(x + i) / float(parts) - 1.0f;
                        const float v = 2.0f * float(y + j) / float(parts) - 1.0f;
                        vertices->push_back(normal + right * u + up * v);
                        normals->push_back(normal);
                    }
        }
        cube->setVertexArray(vertices);
        cube->setNormalArray(normals, osg::Array::BIND_PER_VERTEX);
        cube->addPrimitiveSet(new osg::DrawArrays(GL_QUADS, 0, int(vertices->size())));
        return cube;
    }

    /// The cube with its edges and corners cut off, and normals that turn smoothly over the cuts.
    static osg::ref_ptr<osg::Geometry> makeRoundedCube(float cut)
    {
        osg::ref_ptr<osg::Geometry> cube = new osg::Geometry;
        osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array, normals = new osg::Vec3Array;
        // A corner of the side across an axis.
        const auto add = [&](const osg::Vec3& corner, int axis)
        {
            osg::Vec3 place = corner * (1.0f - cut), normal;
            place[axis] = normal[axis] = corner[axis];
            vertices->push_back(place);
            normals->push_back(normal);
        };
        const auto cornerOf = [](int axis, float at, float u, float v)
        {
            osg::Vec3 corner;
            corner[axis] = at;
            corner[(axis + 1) % 3] = u;
            corner[(axis + 2) % 3] = v;
            return corner;
        };
        for (int axis = 0; axis < 3; ++axis)
            for (const float at : {-1.0f, 1.0f})
            {
                for (const auto& [u, v] : {std::pair(-1.0f, -1.0f), {1, -1}, {1, 1}, {-1, 1}})
                    add(cornerOf(axis, at, u, v), axis);
                for (const float u : {-1.0f, 1.0f}) // to the next axis' side, along the third
                    for (const auto& [v, isNext] :
                         {std::pair(-1.0f, false), {1.0f, false}, {1.0f, true}, {-1.0f, true}})
                        add(cornerOf(axis, at, u, v), isNext ? (axis + 1) % 3 : axis);
            }
        cube->addPrimitiveSet(new osg::DrawArrays(GL_QUADS, 0, int(vertices->size())));
        const int first = int(vertices->size());
        for (int i = 0; i < 8; ++i)
            for (int axis = 0; axis < 3; ++axis)
                add(osg::Vec3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1), axis);
        cube->addPrimitiveSet(new osg::DrawArrays(GL_TRIANGLES, first, 24));
        cube->setVertexArray(vertices);
        cube->setNormalArray(normals, osg::Array::BIND_PER_VERTEX);
        return cube;
    }

    osg::ref_ptr<osg::Image> draw(osg::Node* node)
    {
        osg::ref_ptr<osg::Image> picture = _viewer.renderFloat(node, _camera, Size, Size);
        return osg::clone(picture.get(), osg::CopyOp::DEEP_COPY_ALL);
    }

    /// Where GL_LINE draws, in front of the faces' depth.
    std::vector<bool> drawTruth(osg::Geometry& cube)
    {
        const osg::ref_ptr<osg::Group> root = new osg::Group;
        for (const bool isLine : {false, true})
        {
            const osg::ref_ptr<osg::Group> pass = new osg::Group;
            osg::StateSet& state = *pass->getOrCreateStateSet();
            const osg::ref_ptr<osg::Program> program = new osg::Program;
            program->addShader(
                new osg::Shader(osg::Shader::FRAGMENT, std::string("void main() { gl_FragColor = "
                                                                   "vec4(") +
                                                           (isLine ? "1.0" : "0.0") + "); }"));
            state.setAttribute(program);
            state.setRenderBinDetails(int(isLine), "RenderBin");
            if (isLine)
                state.setAttribute(
                    new osg::PolygonMode(osg::PolygonMode::FRONT_AND_BACK, osg::PolygonMode::LINE));
            else
                state.setAttributeAndModes(new osg::PolygonOffset(1.0f, 4.0f));
            pass->addChild(&cube);
            root->addChild(pass);
        }
        const osg::ref_ptr<osg::Image> picture = draw(root);
        std::vector<bool> lines;
        for (unsigned int y = 0; y < unsigned(Size); ++y)
            for (unsigned int x = 0; x < unsigned(Size); ++x)
                lines.push_back(picture->getColor(x, y).r() > 0.9f && isInside(x, y));
        return lines;
    }

    /// Where the rendering shows the colour of a line rather than that of a face.
    std::vector<bool> drawRendering(const std::string& name, osg::Geometry& cube,
                                    const std::map<std::string, std::vector<double>>& uniforms,
                                    const osg::Vec3& line, const osg::Vec3& face)
    {
        const osg::ref_ptr<MixedScene> scene = new MixedScene;
        scene->addRendering(importNamed(name));
        for (const auto& [uniform, values] : uniforms)
            scene->setUniform(0, uniform, values);
        scene->addChild(&cube);
        const osg::ref_ptr<osg::Image> picture = draw(scene);
        support::writeImage(*picture, name + "Lines");
        std::vector<bool> lines;
        for (unsigned int y = 0; y < unsigned(Size); ++y)
            for (unsigned int x = 0; x < unsigned(Size); ++x)
            {
                const osg::Vec4 color = picture->getColor(x, y);
                const osg::Vec3 seen(color.r(), color.g(), color.b());
                lines.push_back(isInside(x, y) && (seen - line).length() < (seen - face).length());
            }
        return lines;
    }

    bool isCovered(unsigned int x, unsigned int y)
    {
        if (!_covered)
        {
            const osg::ref_ptr<osg::Group> group = new osg::Group;
            const osg::ref_ptr<osg::Program> program = new osg::Program;
            program->addShader(new osg::Shader(osg::Shader::FRAGMENT,
                                               "void main() { gl_FragColor = vec4(9.0); }"));
            group->getOrCreateStateSet()->setAttribute(program);
            group->addChild(makeCube(1));
            _covered = draw(group);
        }
        return _covered->getColor(x, y).r() > 8.0f;
    }

    /// Off the border: a flat side has no outline, and a cut edge is not there.
    bool isInside(unsigned int x, unsigned int y)
    {
        const unsigned int margin = 5;
        if (x < margin || y < margin || x + margin >= unsigned(Size) ||
            y + margin >= unsigned(Size))
            return false;
        return isCovered(x, y) && isCovered(x - margin, y) && isCovered(x + margin, y) &&
               isCovered(x, y - margin) && isCovered(x, y + margin);
    }

    /// The share of `of` that has a pixel of `to` no farther than `reach`.
    static double shareNear(const std::vector<bool>& of, const std::vector<bool>& to, int reach)
    {
        int all = 0, near = 0;
        for (int y = 0; y < Size; ++y)
            for (int x = 0; x < Size; ++x)
            {
                if (!of[std::size_t(y * Size + x)])
                    continue;
                ++all;
                bool isNear = false;
                for (int j = std::max(0, y - reach); j <= std::min(Size - 1, y + reach); ++j)
                    for (int i = std::max(0, x - reach); i <= std::min(Size - 1, x + reach); ++i)
                        isNear = isNear || to[std::size_t(j * Size + i)];
                near += isNear;
            }
        EXPECT_GT(all, 200);
        return double(near) / std::max(all, 1);
    }

    support::HeadlessViewer _viewer{makeSettings()};
    support::CameraSpec _camera = support::CameraSpec::perspective(
        {3.0, -5.0, 3.2}, {0.0, 0.0, 0.0}, {0, 0, 1}, 32.0, 1.0, 1.0, 30.0);
    osg::ref_ptr<osg::Image> _covered;
};

} // namespace

TEST_F(RenderingWiresGLTest, wiresOfALatticeOfSquaresAreTheirPolygonsLines)
{
    const osg::ref_ptr<osg::Geometry> cube = makeCube(4); // edges at multiples of 1 / 2
    const std::vector<bool> truth = drawTruth(*cube);
    const std::vector<bool> wires = drawRendering(
        "wireframe", *cube,
        {{"lines", {2.0}}, {"width", {2.0}}, {"wire", {1, 1, 1}}, {"between", {0, 0, 0}}},
        osg::Vec3(0.6f, 0.6f, 0.6f), osg::Vec3());
    const double found = shareNear(truth, wires, 2), real = shareNear(wires, truth, 2);
    std::cout << 100.0 * found << " % of GL_LINE's pixels have a wire, " << 100.0 * real
              << " % of the wires' have a line\n";
    // Wires are two pixels wide, lines one; both round on their own.
    EXPECT_GT(found, 0.97);
    EXPECT_GT(real, 0.97);
}

TEST_F(RenderingWiresGLTest, featureEdgesOfACubeAreItsLines)
{
    const std::vector<bool> truth = drawTruth(*makeCube(1));
    // Some five pixels are cut off, over which the normal turns.
    const std::vector<bool> edges =
        drawRendering("edges", *makeRoundedCube(0.04f), {}, osg::Vec3(0.05f, 0.07f, 0.12f),
                      osg::Vec3(0.8f, 0.8f, 0.8f));
    const double found = shareNear(truth, edges, 4), real = shareNear(edges, truth, 4);
    std::cout << 100.0 * found << " % of GL_LINE's pixels have an edge, " << 100.0 * real
              << " % of the edges' have a line\n";
    EXPECT_GT(found, 0.95);
    EXPECT_GT(real, 0.95);
}
