// SPDX-License-Identifier: MIT
#include "osgMultiRender/GlslSamples.h"

#include <osgMultiRender/GlslEdit.h>
#include <osgMultiRender/GlslToken.h>
#include <osgMultiRender/GlslWrap.h>
#include <support/FilesBelow.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <random>

using namespace osgMultiRender;

namespace
{

using Kind = GlslToken::Kind;

std::string join(const std::string& text)
{
    std::string joined;
    for (const GlslToken& token : tokenize(text))
    {
        joined += textOf(text, token);
    }
    return joined;
}

std::vector<std::string> words(const std::string& text, Kind kind)
{
    std::vector<std::string> result;
    for (const GlslToken& token : tokenize(text))
    {
        if (token.kind == kind)
        {
            result.emplace_back(textOf(text, token));
        }
    }
    return result;
}

GlslToken find(const std::string& text, const std::string& word)
{
    for (const GlslToken& token : tokenize(text))
    {
        if (textOf(text, token) == word)
        {
            return token;
        }
    }
    ADD_FAILURE() << "no token " << word;
    return {};
}

using Words = std::vector<std::string>;

} // namespace

TEST(GlslTokenTest, tokensJoinToTheTextForAnyBytes)
{
    std::string all;
    for (int byte = 0; byte < 256; ++byte)
    {
        all += static_cast<char>(byte);
    }
    const std::string cases[] = {"",
                                 all,
                                 all + all,
                                 std::string("\0\0a\0", 4),
                                 "\xff\xfe\xc3(\xc3\xa9",
                                 "/* open",
                                 "/*/",
                                 "//",
                                 "// x \\",
                                 "#",
                                 "#\\\n",
                                 "#define a /* open",
                                 "\r\n\r\r\n\n\r",
                                 "a\\\nb \\\r\nc",
                                 "\"quote",
                                 "\\",
                                 "1.",
                                 ".5.e+",
                                 "0x",
                                 "###",
                                 "# # #\n#"};
    for (const std::string& text : cases)
    {
        EXPECT_EQ(join(text), text);
    }
}

TEST(GlslTokenTest, samplesAndInstalledShadersComeBackByteForByte)
{
    std::size_t count = 0;
    for (const glslSamples::Sample& sample : glslSamples::fragmentSamples())
    {
        for (const std::string& text : sample.fragments)
        {
            EXPECT_EQ(join(text), text) << sample.name;
            ++count;
        }
    }
    EXPECT_GE(count, 25u);
    for (const char* folder : {"/usr/share/OpenSceneGraph", "/usr/share/meshlab"})
        for (const auto& path : support::filesBelow(folder, {".frag", ".vert", ".glsl", ".geom"}))
        {
            std::ifstream file(path, std::ios::binary);
            const std::string text{std::istreambuf_iterator<char>(file), {}};
            EXPECT_EQ(join(text), text) << path;
        }
}

TEST(GlslTokenTest, tenThousandMutationsComeBackAndDoNotUpsetModelAndWrapper)
{
    std::mt19937 random(20240607);
    const auto& samples = glslSamples::fragmentSamples();
    static const std::string pieces[] = {
        "{",       "}",        "(",    ")",   "/*", "*/",           "#if X\n",
        "#else\n", "#endif\n", "\\\n", ";",   "\"", "gl_FragColor", "out ",
        "struct ", "[",        "\xff", "main"};
    for (int i = 0; i < 10000; ++i)
    {
        std::string text = samples[random() % samples.size()].fragments[0];
        for (unsigned int change = random() % 5; change < 5; ++change)
        {
            const std::size_t at = random() % (text.size() + 1);
            switch (random() % 4)
            {
            case 0:
                text.insert(at, pieces[random() % std::size(pieces)]);
                break;
            case 1:
                text.erase(at, random() % 20);
                break;
            case 2:
                text.insert(at, text.substr(random() % (text.size() + 1), random() % 40));
                break;
            default:
                text.insert(at, 1, static_cast<char>(random() % 256));
                break;
            }
        }
        ASSERT_EQ(join(text), text);
        const GlslSource source = parseGlsl(text);
        ASSERT_EQ(GlslEdit(source).getText(), text);
        const GlslWrapped wrapped =
            wrapProgram({{GlslStage::Fragment, text}}, {330, GlslVersion::Profile::Compatibility});
        ASSERT_EQ(wrapped.ok, wrapped.errors.empty());
    }
}

TEST(GlslTokenTest, operatorsAreTheLongestThatFit)
{
    EXPECT_EQ(words("a<<=b>>c^^d++ + ++e&&f", Kind::Operator),
              (Words{"<<=", ">>", "^^", "++", "+", "++", "&&"}));
}

TEST(GlslTokenTest, numbersKeepExponentsAndSuffixes)
{
    EXPECT_EQ(words("1.5e-3 0x1Fu .5 2.f 3.0lf 1e+9 0xe+1", Kind::Number),
              (Words{"1.5e-3", "0x1Fu", ".5", "2.f", "3.0lf", "1e+9", "0xe", "1"}));
}

TEST(GlslTokenTest, wordsAreKeywordsByVersion)
{
    EXPECT_EQ(tokenize("sample", 330)[0].kind, Kind::Identifier);
    EXPECT_EQ(tokenize("sample", 400)[0].kind, Kind::Keyword);
    EXPECT_EQ(tokenize("flat", 120)[0].kind, Kind::Identifier);
    EXPECT_EQ(tokenize("buffer", 420)[0].kind, Kind::Identifier);
    EXPECT_EQ(tokenize("buffer", 430)[0].kind, Kind::Keyword);
}

TEST(GlslTokenTest, everyKindOfLineEndCountsOnce)
{
    for (const char* end : {"\n", "\r", "\r\n", "\n\r", "\\\r\n"})
    {
        const std::string text = std::string("a") + end + "  b";
        EXPECT_EQ(find(text, "b").line, 2u);
        EXPECT_EQ(find(text, "b").column, 3u);
    }
    EXPECT_EQ(find("a\r\n\r\nb", "b").line, 3u);
    EXPECT_EQ(find("/* x\n\n*/ b", "b").line, 3u);
    EXPECT_EQ(find("/* x\n\n*/ b", "b").column, 4u);
}

TEST(GlslTokenTest, directivesHoldContinuedLinesAndComments)
{
    EXPECT_EQ(words(" #define A \\\n 1 /* x\ny */ 2 // z\nb # c", Kind::Directive),
              (Words{"#define A \\\n 1 /* x\ny */ 2 // z"}));
    EXPECT_EQ(words("/* c */ #if A\nx\n#endif", Kind::Directive), (Words{"#if A", "#endif"}));
    const std::string text = "a\n  #define B /**/ c";
    const GlslToken directive = find(text, "#define B /**/ c");
    const auto parts = tokenizeDirective(text, directive);
    EXPECT_EQ(textOf(text, parts.back()), "c");
    EXPECT_EQ(parts.back().line, 2u);
    EXPECT_EQ(parts.back().column, 18u);
}

TEST(GlslTokenTest, lineCommentsGoOnBehindABackslash)
{
    EXPECT_EQ(words("// a \\\n b\nc", Kind::Comment), (Words{"// a \\\n b"}));
}

TEST(GlslTokenTest, megabytesOfBracketsAreRead)
{
    // A step that is quadratic would take longer than the suite lets a test run.
    for (const std::string unit : {"(", "{", "[", "if(", "a[", "/*", "#if X\n", "for(;;)", "else "})
    {
        std::string text;
        while (text.size() < (1u << 20))
        {
            text += unit;
        }
        EXPECT_EQ(parseGlsl(text).tokens.back().end, text.size());
    }
}
