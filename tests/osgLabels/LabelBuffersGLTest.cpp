// SPDX-License-Identifier: MIT
#include "LabelCodes.h"

#include <osgLabels/LabelBuffers.h>
#include <osgLabels/Shaders.h>

#include <support/HeadlessViewer.h>
#include <support/NotifyCapture.h>

#include <osg/Drawable>
#include <osg/FrameBufferObject>
#include <osg/GLExtensions>
#include <osg/Program>

#include <cstring>
#include <functional>
#include <random>

using osgLabels::LabelBuffers;
using osgLabels::LabelTable;
using Codes = LabelTable::Codes;

namespace
{

constexpr int Width = 1026 + 65; ///< Length, 1024 codes, style, 65 sums.

const char vertexShader[] = R"(#version 330 compatibility
void main() { gl_Position = vec4(vec2(gl_VertexID & 1, gl_VertexID >> 1) * 4.0 - 1.0, 0.0, 1.0); }
)";

const char fragmentShader[] = R"(
uniform uint id;
out uint result;
void main()
{
    osgLabels_Text text = osgLabels_textOf(id);
    int i = int(gl_FragCoord.x) - 1;
    if (i > 1024)
    {
        int count = i - 1025;
        bool isOne = 16 * (count - 1) < text.length;
        result = isOne ? floatBitsToUint(osgLabels_sumOf(text, count)) : ~0u;
        return;
    }
    result = i < 0 ? uint(text.length) : i == 1024 ? osgLabels_styleOf(id)
           : i < text.length ? osgLabels_code(text, i) : ~0u;
}
)";

/// What a shader says of an identifier.
struct Read
{
    Codes codes;
    std::uint32_t style = 0;
    std::vector<float> sums = {}; ///< From that of no code on.
};

/// Reads a table through GLSL, in the draw thread, when drawn.
class TableReader : public osg::Drawable
{
public:
    using Question = std::function<Read(std::uint32_t)>;

    TableReader(LabelBuffers& buffers, std::function<void(const Question&)> check)
        : _buffers(buffers), _check(std::move(check)), _stateSet(new osg::StateSet)
    {
        setCullingActive(false);
        setUseDisplayList(false);
    }

    void drawImplementation(osg::RenderInfo& renderInfo) const override
    {
        osg::State& state = *renderInfo.getState();
        const auto* gl = state.get<osg::GLExtensions>();
        GLint before = 0;
        GLint viewport[4];
        glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING_EXT, &before);
        glGetIntegerv(GL_VIEWPORT, viewport);
        GLuint framebuffer = 0, target = 0;
        gl->glGenFramebuffers(1, &framebuffer);
        gl->glGenRenderbuffers(1, &target);
        gl->glBindRenderbuffer(GL_RENDERBUFFER_EXT, target);
        gl->glRenderbufferStorage(GL_RENDERBUFFER_EXT, GL_R32UI, Width, 1);
        gl->glBindFramebuffer(GL_FRAMEBUFFER_EXT, framebuffer);
        gl->glFramebufferRenderbuffer(GL_FRAMEBUFFER_EXT, GL_COLOR_ATTACHMENT0_EXT,
                                      GL_RENDERBUFFER_EXT, target);
        glViewport(0, 0, Width, 1);
        setProgram(_buffers.isPaged(state));
        _check([&](std::uint32_t identifier) { return read(state, identifier); });
        gl->glBindFramebuffer(GL_FRAMEBUFFER_EXT, static_cast<GLuint>(before));
        gl->glDeleteFramebuffers(1, &framebuffer);
        gl->glDeleteRenderbuffers(1, &target);
        glViewport(viewport[0], viewport[1], viewport[2], viewport[3]);
    }

private:
    void setProgram(bool isPaged) const
    {
        osg::ref_ptr<osg::Program> program = new osg::Program;
        program->addShader(new osg::Shader(osg::Shader::VERTEX, vertexShader));
        program->addShader(new osg::Shader(
            osg::Shader::FRAGMENT, std::string("#version 330 compatibility\n") +
                                       (isPaged ? "#define OSGLABELS_PAGED\n" : "") +
                                       osgLabels::shaders::labelTable_glsl + fragmentShader));
        _stateSet->setAttribute(program);
    }

    Read read(osg::State& state, std::uint32_t identifier) const
    {
        const auto* gl = state.get<osg::GLExtensions>();
        state.pushStateSet(_buffers.update(state));
        state.pushStateSet(_stateSet.get());
        state.apply();
        const auto* program = state.getLastAppliedProgramObject();
        EXPECT_NE(program, nullptr);
        std::vector<std::uint32_t> pixels(Width);
        if (program)
        {
            const GLint location = gl->glGetUniformLocation(program->getHandle(), "id");
            gl->glUniform1ui(location, identifier);
            glDrawArrays(GL_TRIANGLES, 0, 3);
            glReadPixels(0, 0, Width, 1, GL_RED_INTEGER_EXT, GL_UNSIGNED_INT, pixels.data());
        }
        state.popStateSet();
        state.popStateSet();
        const std::size_t length = std::min<std::size_t>(pixels[0], 1024);
        std::vector<float> sums((length + 15) / 16 + 1);
        std::memcpy(sums.data(), &pixels[1026], sums.size() * sizeof(float));
        return {Codes(pixels.begin() + 1, pixels.begin() + 1 + static_cast<std::ptrdiff_t>(length)),
                pixels[1025], std::move(sums)};
    }

    LabelBuffers& _buffers;
    const std::function<void(const Question&)> _check;
    const osg::ref_ptr<osg::StateSet> _stateSet;
};

const support::CameraSpec Flat = {osg::Matrixd(), osg::Matrixd::ortho(-1, 1, -1, 1, -1, 1)};

class LabelBuffersGLTest : public testing::TestWithParam<bool>
{
protected:
    support::HeadlessViewer viewer;
    std::shared_ptr<LabelTable> table = std::make_shared<LabelTable>();
    LabelBuffers buffers{table, GetParam()};

    void check(const std::function<void(const TableReader::Question&)>& f)
    {
        support::NotifyCapture notify;
        bool isDrawn = false;
        osg::ref_ptr<TableReader> reader = new TableReader(buffers,
                                                           [&](const TableReader::Question& ask)
                                                           {
                                                               isDrawn = true;
                                                               f(ask);
                                                           });
        viewer.render(reader, Flat, 64, 64);
        EXPECT_TRUE(isDrawn);
        EXPECT_EQ(viewer.getGLErrors(), std::vector<std::string>());
    }
    LabelBuffers::Traffic traffic()
    {
        return buffers.getTraffic(
            viewer.getViewer().getCamera()->getGraphicsContext()->getState()->getContextID());
    }
};

} // namespace

TEST_P(LabelBuffersGLTest, sumsOfAdvancesReadBackForEachLength)
{
    OSGKITS_NEED_GL(viewer);
    const auto advanceOf = [](std::uint32_t code) { return 0.25f + 0.0625f * float(code); };
    table->setAdvances(advanceOf);
    check(
        [&](const TableReader::Question& ask)
        {
            for (std::size_t length = 1; length <= 1024; length += length < 70 ? 1 : 53)
                table->setCodes(std::uint32_t(length), sequence(length, 7, 63));
            for (std::size_t length = 1; length <= 1024; length += length < 70 ? 1 : 53)
            {
                const Read read = ask(std::uint32_t(length));
                ASSERT_EQ(read.codes, sequence(length, 7, 63));
                if (length < 32) // has none
                    continue;
                float sum = 0.0f; // exact for such advances
                EXPECT_EQ(read.sums[0], 0.0f);
                for (std::size_t i = 0; i < length; ++i)
                {
                    sum += advanceOf(read.codes[i]);
                    if ((i + 1) % 16 == 0 || i + 1 == length)
                    {
                        ASSERT_EQ(read.sums[i / 16 + 1], sum) << length << ' ' << i;
                    }
                }
            }
        });
}

TEST_P(LabelBuffersGLTest, eachCharacterReadsBack)
{
    OSGKITS_NEED_GL(viewer);
    std::vector<std::size_t> lengths;
    for (std::size_t length = 1; length <= 64; ++length)
        lengths.push_back(length);
    lengths.push_back(1024);
    check(
        [&](const TableReader::Question& ask)
        {
            for (const std::size_t length : lengths)
            {
                const auto first = static_cast<std::uint32_t>(length);
                for (const std::uint32_t identifier : awkward)
                    table->setCodes(identifier, sequence(length, identifier + first, 63));
                for (const std::uint32_t identifier : awkward)
                    ASSERT_EQ(ask(identifier).codes, sequence(length, identifier + first, 63))
                        << "identifier " << identifier << ", length " << length;
            }
            EXPECT_EQ(ask(2).codes, Codes());
            EXPECT_EQ(ask(0).codes, Codes());
        });
}

TEST_P(LabelBuffersGLTest, denseIdentifiersReadBack)
{
    OSGKITS_NEED_GL(viewer);
    check(
        [&](const TableReader::Question& ask)
        {
            for (std::uint32_t identifier = 1; identifier <= 70'000; ++identifier)
                table->setCodes(identifier, sequence(20, identifier, 63));
            for (std::uint32_t identifier : {1u, 2u, 255u, 256u, 65535u, 65536u, 70'000u})
                EXPECT_EQ(ask(identifier).codes, sequence(20, identifier, 63)) << identifier;
            EXPECT_EQ(ask(70'001).codes, Codes());
            EXPECT_EQ(ask(0x7fffffffu).codes, Codes());
            EXPECT_EQ(ask(0).codes, Codes());
        });
}

TEST_P(LabelBuffersGLTest, eachWidthOfCodesReadsBack)
{
    OSGKITS_NEED_GL(viewer);
    check(
        [&](const TableReader::Question& ask)
        {
            for (unsigned int bits = 1; bits <= 20; ++bits)
            {
                const std::uint32_t last = (1u << bits) - 1;
                table->setCodes(1, sequence(100, last, last + 1));
                table->setCodes(2, sequence(33, last / 2, last + 1));
                EXPECT_EQ(ask(1).codes, sequence(100, last, last + 1)) << bits;
                EXPECT_EQ(ask(2).codes, sequence(33, last / 2, last + 1)) << bits;
            }
        });
}

TEST_P(LabelBuffersGLTest, stylesReadBackAndAreZeroBefore)
{
    OSGKITS_NEED_GL(viewer);
    check(
        [&](const TableReader::Question& ask)
        {
            table->setCodes(5, sequence(3, 0, 63));
            EXPECT_EQ(ask(5).style, 0u);
            table->setStyle(7, 3);
            table->setStyle(5, 0xFFFFFFFFu);
            EXPECT_EQ(ask(5).style, 0xFFFFFFFFu);
            EXPECT_EQ(ask(6).style, 0u);
            EXPECT_EQ(ask(7).style, 3u);
            EXPECT_EQ(ask(7).codes, Codes());
            table->setStyle(0x7fffffffu, 9); // now sparse
            EXPECT_EQ(ask(7).style, 3u);
            EXPECT_EQ(ask(8).style, 0u);
            EXPECT_EQ(ask(0x7fffffffu).style, 9u);
        });
}

TEST_P(LabelBuffersGLTest, changesOfAGrowingTableReadBack)
{
    OSGKITS_NEED_GL(viewer);
    check(
        [&](const TableReader::Question& ask)
        {
            std::mt19937 random(3);
            std::vector<Codes> texts(1);
            for (int step = 0; step < 25; ++step)
            {
                // Over the size of a page's row, and of a page in the end.
                for (int i = 0; i < 20'000; ++i)
                {
                    const auto number = static_cast<std::uint32_t>(texts.size());
                    texts.push_back(sequence(5 + number % 50, number, 63));
                    for (std::size_t digit = 0, rest = number; digit < 4; ++digit, rest /= 63)
                        texts.back()[digit] = static_cast<std::uint32_t>(rest % 63);
                    table->setCodes(number, texts.back());
                }
                for (int i = 0; i < 500; ++i)
                {
                    const auto number =
                        1 + random() % (static_cast<std::uint32_t>(texts.size()) - 1);
                    texts[number] = sequence(1 + random() % 40, random(), 63);
                    table->setCodes(number, texts[number]);
                }
                for (int i = 0; i < 20; ++i)
                {
                    const auto number =
                        1 + random() % (static_cast<std::uint32_t>(texts.size()) - 1);
                    ASSERT_EQ(ask(number).codes, texts[number]) << number << " in step " << step;
                }
            }
        });
}

TEST_P(LabelBuffersGLTest, uploadsOnlyWhatChanged)
{
    OSGKITS_NEED_GL(viewer);
    check(
        [&](const TableReader::Question& ask)
        {
            for (std::uint32_t identifier = 1; identifier <= 10'000; ++identifier)
                table->setCodes(identifier, sequence(20, identifier, 63));
            ask(1);
            table->setCodes(5000, sequence(20, 31, 47));
            EXPECT_EQ(ask(5000).codes, sequence(20, 31, 47));
            EXPECT_LE(traffic().bytesSent, 24u);
            ask(5000);
            EXPECT_EQ(traffic().bytesSent, 0u);
        });
}

TEST_P(LabelBuffersGLTest, releasedBuffersComeBack)
{
    OSGKITS_NEED_GL(viewer);
    table->setCodes(1, sequence(20, 1, 63));
    for (int round = 0; round < 3; ++round)
    {
        check([&](const TableReader::Question& ask)
              { EXPECT_EQ(ask(1).codes, sequence(20, 1, 63)); });
        EXPECT_GT(traffic().bytesHeld, 0u);
        buffers.releaseGLObjects(nullptr);
        EXPECT_EQ(traffic().bytesHeld, 0u);
    }
}

TEST_P(LabelBuffersGLTest, twoMillionTextsStaySmallAndReadBack)
{
    OSGKITS_NEED_GL(viewer);
    constexpr std::uint32_t count = 2'000'000;
    const auto tag = [](std::uint32_t number)
    {
        Codes codes = sequence(20, number, 63);
        for (std::size_t i = 0; i < 4; ++i, number /= 63)
            codes[i] = number % 63;
        return codes;
    };
    table->setAdvances([](std::uint32_t code) { return 0.5f + 0.01f * float(code); });
    for (std::uint32_t identifier = 1; identifier <= count; ++identifier)
        table->setCodes(identifier, tag(identifier));
    check(
        [&](const TableReader::Question& ask)
        {
            EXPECT_EQ(ask(count).codes, tag(count));
            for (std::uint32_t identifier = 1; identifier <= count; identifier += 19'997)
                ASSERT_EQ(ask(identifier).codes, tag(identifier));
        });
    EXPECT_EQ(table->getSizes().texts, count);
    // Pages are whole: up to 8 MiB more.
    EXPECT_LT(traffic().bytesHeld, std::size_t(GetParam() ? 38 + 8 : 38) << 20);
    std::cout << "on the GPU: " << traffic().bytesHeld / 1048576.0
              << " MiB, main memory: " << table->getSizes().mainBytes / 1048576.0 << " MiB\n";
}

INSTANTIATE_TEST_SUITE_P(Buffers, LabelBuffersGLTest, testing::Bool(),
                         [](const auto& isPaged) { return isPaged.param ? "paged" : "plain"; });
