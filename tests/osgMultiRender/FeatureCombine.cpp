// SPDX-License-Identifier: MIT
#include "FeatureSubject.h"

#include <osg/StateSet>
#include <osg/TexEnvCombine>

namespace feature
{

namespace
{

using Combine = osg::TexEnvCombine;
using Change = std::function<void(Combine&)>;

/// Three textures on units 0 to 2; the combiner is that of unit 1, the others' colors stay.
Build withCombine(const Change& change)
{
    return [change](osg::Group& root)
    {
        osg::StateSet* state = root.getOrCreateStateSet();
        for (unsigned int unit = 0; unit < 4; ++unit)
            state->setTextureAttributeAndModes(unit, texture2D(GL_RGBA, unit));
        osg::ref_ptr<Combine> pass = new Combine;
        pass->setCombine_RGB(Combine::REPLACE);
        pass->setCombine_Alpha(Combine::REPLACE);
        pass->setSource0_RGB(Combine::PREVIOUS);
        pass->setSource0_Alpha(Combine::PREVIOUS);
        for (unsigned int unit : {2, 3})
            state->setTextureAttributeAndModes(unit, pass);
        osg::ref_ptr<Combine> combine = new Combine;
        combine->setConstantColor(osg::Vec4(0.8f, 0.5f, 0.3f, 0.6f));
        change(*combine);
        state->setTextureAttributeAndModes(1, combine);
        state->setMode(GL_LIGHTING, osg::StateAttribute::OFF);
    };
}

Subject colored()
{
    Subject subject;
    subject.colors = Subject::Colors::PerVertex;
    return subject;
}

void addFunctions(Family& family)
{
    const std::vector<std::pair<std::string, GLint>> functions = {
        {"Replace", Combine::REPLACE},
        {"Modulate", Combine::MODULATE},
        {"Add", Combine::ADD},
        {"AddSigned", Combine::ADD_SIGNED},
        {"Interpolate", Combine::INTERPOLATE},
        {"Subtract", Combine::SUBTRACT},
        {"Dot3Rgb", Combine::DOT3_RGB},
        {"Dot3Rgba", Combine::DOT3_RGBA}};
    for (const auto& [name, function] : functions)
    {
        family.add("rgb" + name, withCombine([f = function](Combine& c) { c.setCombine_RGB(f); }),
                   colored());
        if (function == Combine::DOT3_RGB || function == Combine::DOT3_RGBA)
            continue;
        family.add("alpha" + name,
                   withCombine(
                       [f = function](Combine& c)
                       {
                           c.setCombine_RGB(Combine::REPLACE);
                           c.setSource0_RGB(Combine::PRIMARY_COLOR);
                           c.setCombine_Alpha(f);
                           c.setSource0_Alpha(Combine::PREVIOUS);
                           c.setSource1_Alpha(Combine::TEXTURE);
                       }),
                   colored());
    }
}

void addSources(Family& family)
{
    const std::vector<std::pair<std::string, GLint>> sources = {
        {"Texture", Combine::TEXTURE},       {"Texture0", Combine::TEXTURE0},
        {"Texture1", Combine::TEXTURE1},     {"Texture2", Combine::TEXTURE2},
        {"Texture3", Combine::TEXTURE3},     {"Constant", Combine::CONSTANT},
        {"Primary", Combine::PRIMARY_COLOR}, {"Previous", Combine::PREVIOUS}};
    for (const auto& [name, source] : sources)
    {
        const auto change = [s = source](Combine& c)
        {
            c.setCombine_RGB(Combine::REPLACE);
            c.setCombine_Alpha(Combine::REPLACE);
            c.setSource0_RGB(s);
            c.setSource0_Alpha(s);
        };
        FeatureScene& scene = family.add("source" + name, withCombine(change), colored());
        if (source == Combine::TEXTURE)
            scene.twin = "sourceTexture1";
    }
    family.add("sourcesAllThree",
               withCombine(
                   [](Combine& c)
                   {
                       c.setCombine_RGB(Combine::INTERPOLATE);
                       c.setSource0_RGB(Combine::TEXTURE0);
                       c.setSource1_RGB(Combine::TEXTURE3);
                       c.setSource2_RGB(Combine::PRIMARY_COLOR);
                       c.setOperand2_RGB(Combine::SRC_COLOR);
                   }),
               colored());
}

void addOperands(Family& family)
{
    const std::vector<std::pair<std::string, GLint>> operands = {
        {"Color", Combine::SRC_COLOR},
        {"OneMinusColor", Combine::ONE_MINUS_SRC_COLOR},
        {"Alpha", Combine::SRC_ALPHA},
        {"OneMinusAlpha", Combine::ONE_MINUS_SRC_ALPHA}};
    for (const auto& [name, operand] : operands)
    {
        FeatureScene& plain = family.add("operand0" + name,
                                         withCombine(
                                             [o = operand](Combine& c)
                                             {
                                                 c.setCombine_RGB(Combine::MODULATE);
                                                 c.setSource0_RGB(Combine::TEXTURE);
                                                 c.setOperand0_RGB(o);
                                             }),
                                         colored());
        if (operand == Combine::SRC_COLOR)
            plain.twin = "rgbModulate";
        family.add("operand2" + name,
                   withCombine(
                       [o = operand](Combine& c)
                       {
                           c.setCombine_RGB(Combine::INTERPOLATE);
                           c.setSource0_RGB(Combine::TEXTURE);
                           c.setSource1_RGB(Combine::TEXTURE2);
                           c.setSource2_RGB(Combine::TEXTURE0);
                           c.setOperand2_RGB(o);
                       }),
                   colored());
    }
    family.add("operandAlphaOneMinus",
               withCombine(
                   [](Combine& c)
                   {
                       c.setCombine_RGB(Combine::REPLACE);
                       c.setCombine_Alpha(Combine::MODULATE);
                       c.setSource1_Alpha(Combine::TEXTURE);
                       c.setOperand1_Alpha(Combine::ONE_MINUS_SRC_ALPHA);
                   }),
               colored());
}

void addScales(Family& family)
{
    for (float scale : {1.0f, 2.0f, 4.0f})
    {
        family.add("scaleRgb" + std::to_string(int(scale)),
                   withCombine(
                       [scale](Combine& c)
                       {
                           c.setSource0_RGB(Combine::TEXTURE2);
                           c.setSource1_RGB(Combine::TEXTURE3);
                           c.setScale_RGB(scale);
                       }),
                   colored());
        family.add("scaleAlpha" + std::to_string(int(scale)),
                   withCombine(
                       [scale](Combine& c)
                       {
                           c.setCombine_RGB(Combine::ADD);
                           c.setSource1_RGB(Combine::CONSTANT);
                           c.setSource1_Alpha(Combine::CONSTANT);
                           c.setScale_Alpha(scale);
                       }),
                   colored());
    }
    family.add("dot3WithScaleAndAlphaFunction",
               withCombine(
                   [](Combine& c)
                   {
                       c.setCombine_RGB(Combine::DOT3_RGB);
                       c.setSource1_RGB(Combine::PRIMARY_COLOR);
                       c.setCombine_Alpha(Combine::ADD);
                       c.setScale_RGB(2.0f);
                   }),
               colored());
}

} // namespace

void addCombineScenes(std::vector<FeatureScene>& scenes)
{
    Family family(scenes, "combine");
    addFunctions(family);
    addSources(family);
    addOperands(family);
    addScales(family);
}

} // namespace feature
