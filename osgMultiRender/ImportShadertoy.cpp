// SPDX-License-Identifier: MIT
#include <osgMultiRender/Import.h>

#include <osgMultiRender/ImportFile.h>

namespace osgMultiRender
{

namespace
{

constexpr char Vertex[] = R"(#version 330 compatibility
out vec2 osgmr_at;
void main()
{
    osgmr_at = gl_MultiTexCoord0.xy;
    gl_Position = ftransform();
}
)";

// Before the author's text, on its first line.
constexpr char Head[] =
    "#version 330 compatibility\n"
    "uniform vec3 iResolution; uniform float osg_FrameTime; uniform float osg_DeltaFrameTime; "
    "uniform int osg_FrameNumber; uniform vec4 iMouse; uniform vec4 iDate; "
    "uniform float iSampleRate; uniform float iChannelTime[4]; uniform vec3 iChannelResolution[4];\n"
    "#define iTime osg_FrameTime\n"
    "#define iTimeDelta osg_DeltaFrameTime\n"
    "#define iFrameRate (1.0 / osg_DeltaFrameTime)\n"
    "#define iFrame osg_FrameNumber\n"
    "in vec2 osgmr_at; out vec4 osgmr_image;\n";

constexpr char Main[] =
    "\nvoid main() { osgmr_image = vec4(0.0, 0.0, 0.0, 1.0); "
    "mainImage(osgmr_image, osgmr_at * iResolution.xy); }\n";

} // namespace

Rendering importShadertoy(const std::string& text, const std::string& fileName)
{
    Rendering rendering;
    rendering.name = baseName(fileName);
    rendering.fileName = fileName;
    std::string head = Head;
    for (int i = 0; i < 4; ++i)
    {
        const std::string channel = "iChannel" + std::to_string(i);
        if (text.find(channel) != std::string::npos)
        {
            head += "uniform sampler2D " + channel + ";\n";
            uniformOf(rendering, channel).values = {static_cast<double>(i)};
            uniformOf(rendering, channel).type = "sampler2D";
        }
    }
    uniformOf(rendering, "iResolution").values = {512.0, 512.0, 1.0};
    uniformOf(rendering, "iResolution").type = "vec3";
    rendering.shaders.push_back({GlslStage::Vertex, Vertex, fileName});
    rendering.shaders.push_back({GlslStage::Fragment, head + "#line 1\n" + text + Main, fileName});
    return rendering;
}

} // namespace osgMultiRender
