// SPDX-License-Identifier: MIT
// Mixes of one to eight renderings: built-in, imported pairs, a project; of GLSL 1.10 to 4.50.
#include "osgMultiRender/MixedPictures.h"

#include <support/TemporaryFolder.h>

using namespace osgMultiRender;

namespace
{

class MixedKindsGLTest : public MixedPictures
{
protected:
    /// One to mix, and its texts as they draw alone.
    struct Kind
    {
        Rendering rendering;
        osg::ref_ptr<osg::StateSet> alone;
    };

    static Kind makeKind(const Rendering& rendering, const std::string& vertex,
                         const std::string& fragment)
    {
        EXPECT_TRUE(rendering.ok()) << rendering.name;
        return {rendering, makeRenderingState({rendering.name, false, vertex, fragment})};
    }

    static Kind makeBuiltIn(const std::string& name)
    {
        const BuiltInRendering& texts = *findBuiltInRendering(name);
        return makeKind(importNamed(name), texts.vertex, texts.fragment);
    }

    Kind makePair(const std::string& name, const std::string& vertex, const std::string& fragment)
    {
        _folder.write(name + ".vert", vertex);
        return makeKind(importNamed(_folder.write(name + ".frag", fragment)), vertex, fragment);
    }

    Kind makeProject()
    {
        const std::string vertex = "varying vec3 n;\nvoid main()\n{\n    n = gl_Normal;\n"
                                   "    gl_Position = ftransform();\n}\n";
        const std::string fragment = "varying vec3 n;\nvoid main()\n{\n"
                                     "    gl_FragColor = vec4(0.5 + 0.5 * n, 1.0);\n}\n";
        _folder.write("project.vert", vertex);
        _folder.write("project.frag", fragment);
        const std::string text =
            "<GLSLang><VPCount numero=\"1\"><Filenames>"
            "<Filename0 VertexProgram=\"project.vert\"/></Filenames></VPCount>"
            "<FPCount numero=\"1\"><Filenames><Filename0 FragmentProgram=\"project.frag\"/>"
            "</Filenames></FPCount></GLSLang>";
        return makeKind(importNamed(_folder.write("project.gdp", text)), vertex, fragment);
    }

    std::vector<Kind> makeKinds()
    {
        return {
            makeBuiltIn("phong"),
            makePair("in330",
                     "#version 330 compatibility\nout vec3 n;\nvoid main()\n{\n"
                     "    n = gl_NormalMatrix * gl_Normal;\n    gl_Position = ftransform();\n}\n",
                     "#version 330 compatibility\nin vec3 n;\nout vec4 shown;\nvoid main()\n{\n"
                     "    shown.a = 1.0;\n    shown.rgb = abs(normalize(n));\n}\n"),
            makeProject(),
            makeBuiltIn("toon"),
            makePair("half400",
                     "#version 400 compatibility\nout vec3 n;\nvoid main()\n{\n"
                     "    n = gl_Vertex.xyz;\n    gl_Position = ftransform();\n}\n",
                     "#version 400 compatibility\nin vec3 n;\nout vec4 shown;\nvoid main()\n{\n"
                     "    shown = vec4(fma(sin(n * 3.0), vec3(0.4), vec3(0.5)), 1.0);\n}\n"),
            makeBuiltIn("textured"),
            makePair("data120",
                     "#version 120\nvarying float n;\nvoid main()\n{\n    n = gl_Vertex.z;\n"
                     "    gl_Position = ftransform();\n}\n",
                     "#version 120\nvarying float n;\nvoid main()\n{\n"
                     "    gl_FragData[0] = vec4(0.2, 0.7, 0.3, 1.0);\n"
                     "    if (n < 0.0)\n        return;\n    gl_FragData[0].gr *= 0.5;\n}\n"),
            makePair("place450",
                     "#version 450 compatibility\nlayout(location = 3) out vec2 n;\n"
                     "void main()\n{\n    n = gl_MultiTexCoord0.xy;\n"
                     "    gl_Position = ftransform();\n}\n",
                     "#version 450 compatibility\nlayout(location = 3) in vec2 n;\n"
                     "layout(location = 0) out vec4 shown;\nvoid main()\n{\n"
                     "    shown = vec4(n, 0.5 * n.x, 1.0);\n}\n")};
    }

    support::TemporaryFolder _folder;
};

} // namespace

TEST_F(MixedKindsGLTest, oneToEightEqualTheBlendOfTheirPictures)
{
    MixTruth truth(_viewer, _model, _camera, Size);
    std::vector<Kind> kinds = makeKinds();
    for (std::size_t i = 0; i < kinds.size(); ++i)
    {
        SCOPED_TRACE(kinds[i].rendering.name);
        truth.add(kinds[i].alone);
        const double from = 0.4 * double(i);
        _ranges.push_back({from - 0.4, from, from, from + 0.4});
        _scene = new MixedScene;
        for (std::size_t k = 0; k <= i; ++k)
            _scene->addRendering(kinds[k].rendering, _ranges[k]);
        setKeys({{-1.6, -1.0, 0.5}, {1.0, 0.0, 0.0}, {2.0, 1.0, 1.0}}, KeyMode::Polyline);
        support::NotifyCapture capture;
        const osg::ref_ptr<osg::Image> picture = draw();
        EXPECT_EQ(capture.takeWarnings(), support::NotifyCapture::Lines());
        ASSERT_TRUE(picture);
        support::writeImage(*picture, "mixedKinds" + std::to_string(i + 1));
        const MixTruth::Difference difference =
            truth.compare(*picture, _points, MixWeights(_ranges));
        std::cout << i + 1 << " renderings: " << difference.covered << " pixels, "
                  << difference.mixed << " mixed, worst " << difference.worst * 255.0 << "/255\n";
        EXPECT_GT(difference.covered, Size * Size / 8);
        EXPECT_GT(difference.mixed, i > 0 ? difference.covered / 100 : -1);
        EXPECT_EQ(difference.over, 0);
    }
}
