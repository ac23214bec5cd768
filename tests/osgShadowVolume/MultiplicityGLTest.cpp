// SPDX-License-Identifier: MIT
#include "SilhouetteMeshes.h"

#include <osgShadowVolume/CasterMesh.h>
#include <osgShadowVolume/Silhouette.h>
#include <osgShadowVolume/VolumeProgram.h>

#include <support/HeadlessViewer.h>
#include <support/NotifyCapture.h>

#include <osg/BufferObject>
#include <osg/GLExtensions>
#include <osg/Geometry>

#include <gtest/gtest.h>

#include <regex>

using namespace osgShadowVolume;

namespace
{

constexpr GLenum TransformFeedbackBuffer = 0x8C8E;
constexpr GLenum RasterizerDiscard = 0x8C89;

/// Draws a Geometry into a buffer of the multiplicities of its volume's corners.
class Recorder : public osg::Drawable
{
public:
    Recorder(osg::Geometry* geometry, std::size_t capacity)
        : _geometry(geometry), _capacity(capacity)
    {
        setUseDisplayList(false);
        setCullingActive(false);
    }

    void drawImplementation(osg::RenderInfo& renderInfo) const override
    {
        auto* gl = renderInfo.getState()->get<osg::GLExtensions>();
        GLuint buffer = 0;
        gl->glGenBuffers(1, &buffer);
        gl->glBindBuffer(GL_ARRAY_BUFFER_ARB, buffer);
        gl->glBufferData(GL_ARRAY_BUFFER_ARB, GLsizeiptr(_capacity * sizeof(float)), nullptr,
                         GL_STREAM_READ);
        gl->glBindBuffer(GL_ARRAY_BUFFER_ARB, 0);
        gl->glBindBufferBase(TransformFeedbackBuffer, 0, buffer);
        GLuint query = 0;
        gl->glGenQueries(1, &query);
        glEnable(RasterizerDiscard);
        gl->glBeginQuery(GL_TRANSFORM_FEEDBACK_PRIMITIVES_WRITTEN, query);
        gl->glBeginTransformFeedback(GL_TRIANGLES);
        _geometry->drawImplementation(renderInfo);
        gl->glEndTransformFeedback();
        gl->glEndQuery(GL_TRANSFORM_FEEDBACK_PRIMITIVES_WRITTEN);
        glDisable(RasterizerDiscard);
        GLuint triangles = 0;
        gl->glGetQueryObjectuiv(query, GL_QUERY_RESULT, &triangles);
        recorded.resize(3 * std::size_t(triangles));
        gl->glGetBufferSubData(TransformFeedbackBuffer, 0,
                               GLsizeiptr(recorded.size() * sizeof(float)), recorded.data());
        gl->glBindBufferBase(TransformFeedbackBuffer, 0, 0);
        gl->glDeleteQueries(1, &query);
        gl->glDeleteBuffers(1, &buffer);
        renderInfo.getState()->dirtyAllVertexArrays();
    }

    osg::BoundingBox computeBoundingBox() const override
    {
        return osg::BoundingBox(-1, -1, -1, 1, 1, 1);
    }

    mutable std::vector<float> recorded;

private:
    osg::ref_ptr<osg::Geometry> _geometry;
    std::size_t _capacity;
};

/// A CasterMesh of a heap of triangles.
osg::ref_ptr<CasterMesh> meshOf(const HardCase& hard)
{
    osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
    osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array;
    for (const HardCase::Triangle& t : hard.triangles)
        for (const glm::vec3& v : t)
            vertices->push_back(osg::Vec3(v.x, v.y, v.z));
    geometry->setVertexArray(vertices);
    geometry->addPrimitiveSet(new osg::DrawArrays(GL_TRIANGLES, 0, int(vertices->size())));
    osg::ref_ptr<CasterMesh> mesh = new CasterMesh;
    mesh->build({geometry});
    return mesh;
}

class MultiplicityGLTest : public testing::Test
{
protected:
    /// What the program says of the geometry, one value a corner of each triangle that it draws.
    std::vector<float> record(VolumePart part, int glslVersion, osg::Geometry* geometry,
                              const EdgeMesh& edges, const MeshLight& light)
    {
        osg::ref_ptr<osg::Program> program = makeVolumeProgram(part, glslVersion);
        program->addTransformFeedBackVarying("osgsv_multiplicity");
        program->setTransformFeedBackMode(GL_INTERLEAVED_ATTRIBS);
        const std::size_t indices = geometry->getPrimitiveSet(0)->getNumIndices();
        osg::ref_ptr<Recorder> recorder = new Recorder(geometry, 6 * (indices / 3 + 1));
        osg::StateSet* state = recorder->getOrCreateStateSet();
        state->setAttributeAndModes(program);
        state->addUniform(
            new osg::Uniform("osgsv_localLight", osg::Vec4(light.light.x, light.light.y,
                                                           light.light.z, light.light.w)));
        state->addUniform(new osg::Uniform("osgsv_lightRest",
                                           osg::Vec3(light.rest.x, light.rest.y, light.rest.z)));
        state->addUniform(new osg::Uniform("osgsv_meshScale", edges.scale));
        state->addUniform(new osg::Uniform("osgsv_handedness", 1.0f));
        support::NotifyCapture capture;
        _viewer.render(recorder, support::CameraSpec(), 16, 16);
        EXPECT_TRUE(capture.takeWarnings().empty());
        return recorder->recorded;
    }

    support::HeadlessViewer _viewer;
};

/// What the CPU finds for the group, each value that is not 0 six times: a quad is two triangles.
std::vector<float> expectedSides(const EdgeMesh& edges, const EdgeMesh::Group& group,
                                 const MeshLight& light)
{
    std::vector<float> expected;
    for (std::size_t at = 0; at != group.indices.size(); at += 2 + group.opposites)
        if (const int count =
                multiplicity(edges, group.indices.data() + at, group.opposites, light))
            expected.insert(expected.end(), 6, float(count));
    return expected;
}

/// The same for the pairs of opposite vertices that lines with adjacency are made of.
std::vector<float> expectedPairs(const EdgeMesh& edges, const MeshLight& light)
{
    EdgeMesh::Group pairs{2, {}};
    for (const EdgeMesh::Group& group : edges.groups)
        for (std::size_t at = 0; at != group.indices.size(); at += 2 + group.opposites)
            for (std::uint32_t i = 2; i < 2 + group.opposites; i += 2)
            {
                const std::uint32_t* record = group.indices.data() + at;
                const std::uint32_t second =
                    i + 1 < 2 + group.opposites ? record[i + 1] : record[0];
                pairs.indices.insert(pairs.indices.end(),
                                     {record[0], record[1], record[i], second});
            }
    return expectedSides(edges, pairs, light);
}

std::vector<float> expectedCaps(const EdgeMesh& edges, const MeshLight& light)
{
    std::vector<float> expected;
    for (const glm::uvec3& t : edges.triangles)
        if (const int side = facing(edges.vertices[t.x], edges.vertices[t.y], edges.vertices[t.z],
                                    light, edges.scale))
            expected.insert(expected.end(), light.light.w == 0.0f ? 3 : 6, float(side));
    return expected;
}

std::size_t disagreements(const std::vector<float>& a, const std::vector<float>& b)
{
    std::size_t count = std::max(a.size(), b.size()) - std::min(a.size(), b.size());
    for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
        count += a[i] != b[i];
    return count;
}

std::vector<HardCase> subjects()
{
    std::vector<HardCase> subjects = hardCases(0.0);
    for (HardCase& hard : hardCases(1e4))
        subjects.push_back(std::move(hard));
    for (HardCase& hard : subjects)
        hard.lights.resize(2);
    subjects.push_back(grazingTriangles(1000000));
    for (const unsigned int count : {3u, 29u, 30u, 31u, 33u, 100u})
        subjects.push_back(book(count));
    subjects.push_back(moebiusStrip(40));
    return subjects;
}

} // namespace

TEST_F(MultiplicityGLTest, allTechniquesFindWhatTheCPUFinds)
{
    OSGKITS_NEED_GL(_viewer);
    std::size_t compared = 0;
    for (const HardCase& hard : subjects())
    {
        const osg::ref_ptr<CasterMesh> mesh = meshOf(hard);
        const EdgeMesh& edges = mesh->getEdges();
        for (const glm::dvec4& worldLight : hard.lights)
        {
            const MeshLight light = toMeshLight(edges, worldLight);
            SCOPED_TRACE(hard.name);
            for (std::size_t i = 0; i != edges.groups.size(); ++i)
            {
                const auto expected = expectedSides(edges, edges.groups[i], light);
                const auto found =
                    record(VolumePart::TESS_SIDES, 400, mesh->getPatches()[i], edges, light);
                EXPECT_EQ(disagreements(found, expected), 0u)
                    << "tess, " << edges.groups[i].opposites << " opposites";
                compared += expected.size() / 6;
            }
            for (const int version : {330, 400})
                EXPECT_EQ(disagreements(record(VolumePart::GEOMETRY_SIDES, version,
                                               mesh->getLines(), edges, light),
                                        expectedPairs(edges, light)),
                          0u)
                    << "geometry, GLSL " << version;
            EXPECT_EQ(
                disagreements(record(VolumePart::CAPS, 330, mesh->getTriangles(), edges, light),
                              expectedCaps(edges, light)),
                0u)
                << "caps";
        }
    }
    std::cout << compared << " sides compared\n";
    EXPECT_GT(compared, 1000000u);
}

TEST(VolumeProgramText, preciseCoversTheWholeJudgement)
{
    // No driver at hand contracts, so the text is what can be checked.
    const std::regex body(R"(int osgsv_facing\([^)]*\)\s*\{([^}]*)\})");
    const std::regex declared(R"(^\s*precise\s+(vec3|float)\s+\w+\s*=)");
    const std::regex returned(
        R"(^\s*return\s+side\s*>\s*0\.0\s*\?\s*1\s*:\s*side\s*<\s*0\.0\s*\?\s*-1\s*:\s*0$)");
    for (const auto& [part, stage] :
         {std::make_pair(VolumePart::TESS_SIDES, osg::Shader::TESSCONTROL),
          std::make_pair(VolumePart::GEOMETRY_SIDES, osg::Shader::GEOMETRY),
          std::make_pair(VolumePart::CAPS, osg::Shader::GEOMETRY)})
    {
        const std::string text = volumeShaderText(part, stage, 330);
        std::smatch match;
        ASSERT_TRUE(std::regex_search(text, match, body));
        std::istringstream statements(match[1].str());
        std::string statement;
        int steps = 0;
        while (std::getline(statements, statement, ';'))
        {
            if (statement.find_first_not_of(" \n") == std::string::npos)
                continue;
            const bool isStep = std::regex_search(statement, declared);
            EXPECT_TRUE(isStep || std::regex_search(statement, returned)) << statement;
            // Built-in functions may be evaluated in any way.
            EXPECT_EQ(statement.find("dot("), std::string::npos);
            EXPECT_EQ(statement.find("cross("), std::string::npos);
            steps += isStep;
        }
        EXPECT_EQ(steps, 5);
        EXPECT_NE(text.find("GL_ARB_gpu_shader5 : require"), std::string::npos);
        EXPECT_EQ(volumeShaderText(part, stage, 400).find("GL_ARB_gpu_shader5"), std::string::npos);
    }
    const std::string vertex = volumeShaderText(VolumePart::CAPS, osg::Shader::VERTEX, 330);
    EXPECT_NE(vertex.find("precise vec3 away"), std::string::npos);
    EXPECT_NE(vertex.find("precise vec4 extruded"), std::string::npos);
}
