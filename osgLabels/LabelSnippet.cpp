// SPDX-License-Identifier: MIT
// What LabelPass adds to the programs of the leaves.
#include <osgLabels/LabelPass.h>
#include <osgLabels/MapPass.h>

namespace osgLabels
{

using osgMultiRender::SurfaceKey;
using osgMultiRender::SurfaceSnippet;

SurfaceSnippet LabelPass::makeSnippet(const SurfaceKey& key) const
{
    if (key.output & MapOccluder)
        return MapPass::makeSnippet(key);
    SurfaceSnippet snippet;
    const bool diverted = key.output & Diverted;
    if (diverted)
        snippet.fragment = LabelSources::surface();
    addTexCoords(key, snippet);
    if (key.output & Labelled)
    {
        addIndex(key, snippet);
        if (!diverted)
            addLabel(key, snippet);
    }
    if (!diverted)
        return snippet;
    snippet.fragment += "uniform int osgLabels_frame;\n";
    snippet.statements += "    osgLabels_writeSurface(" +
                          std::string(key.output & Labelled ? "osgLabels_index" : "0") +
                          ", osgLabels_frame);\n";
    return snippet;
}

void LabelPass::addIndex(const SurfaceKey& key, SurfaceSnippet& snippet)
{
    if (key.output & IndexUniform)
    {
        snippet.fragment += "uniform int osgLabels_index;\n";
        return;
    }
    // A PrimitiveBatch' VertexSnippet has the inputs already.
    snippet.vertex += "#ifndef OSGLABELS_OBJECT\n"
                      "#define OSGLABELS_OBJECT\n"
                      "layout(location = 6) in int osgLabels_object;\n"
                      "#endif\n"
                      "uniform int osgLabels_recordBase;\n"
                      "flat out int osgLabels_index;\n";
    snippet.vertexStatements +=
        "    osgLabels_index = osgLabels_object + gl_InstanceID + osgLabels_recordBase;\n";
    snippet.fragment += "flat in int osgLabels_index;\n";
}

void LabelPass::addTexCoords(const SurfaceKey& key, SurfaceSnippet& snippet) const
{
    const bool diverted = key.output & Diverted, given = key.output & TexCoords;
    if (given)
    {
        const std::string unit = std::to_string(key.output >> UnitShift);
        snippet.vertex += "out vec2 osgLabels_texCoord;\n";
        snippet.vertexStatements += "    osgLabels_texCoord = gl_MultiTexCoord" + unit + ".xy;\n";
        snippet.fragment += "in vec2 osgLabels_texCoord;\n";
    }
    if (!diverted || _resources->settings.texCoord < 0)
        return;
    snippet.fragment += "layout(location = 2) out vec2 osgLabels_outTexCoord;\n"
                        "layout(location = 3) out vec4 osgLabels_outChange;\n";
    snippet.statements += given ? "    osgLabels_outTexCoord = osgLabels_texCoord;\n"
                                  "    osgLabels_outChange = vec4(dFdx(osgLabels_texCoord), "
                                  "dFdy(osgLabels_texCoord));\n"
                                : "    osgLabels_outTexCoord = vec2(0.0);\n"
                                  "    osgLabels_outChange = vec4(0.0);\n";
}

void LabelPass::addLabel(const SurfaceKey& key, SurfaceSnippet& snippet) const
{
    snippet.fragment += LabelSources::locate(_resources->getDefines(key.output & Paged, ~0u)) +
                        LabelSources::ink() + LabelSources::direct();
    snippet.statements +=
        key.output & TexCoords
            ? "    osgmr_out0 = osgLabels_direct(osgmr_out0, osgLabels_index, osgLabels_texCoord, "
              "vec4(dFdx(osgLabels_texCoord), dFdy(osgLabels_texCoord)));\n"
            : "    osgmr_out0 = osgLabels_direct(osgmr_out0, osgLabels_index, vec2(0.0), "
              "vec4(0.0));\n";
}

} // namespace osgLabels
