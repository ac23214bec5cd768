// SPDX-License-Identifier: MIT
// Decodes pictures: each letter is the glyph that it should be, whatever its label's identifier.
#include "CoverageTruth.h"
#include "LabelPictures.h"

#include <osgLabels/LabelResources.h>
#include <osgLabels/PrimitiveBatch.h>

#include <support/NotifyCapture.h>

#include <cmath>
#include <string>
#include <vector>

using namespace labelScene;
using osgLabels::LabelScene;

namespace
{

/// One unit is one pixel, from the lower left corner.
constexpr int PageWidth = 800, PageHeight = 260, CellWidth = 12, RowHeight = 32;

support::HeadlessViewer& pageViewer()
{
    static support::HeadlessViewer theViewer({PageWidth, PageHeight});
    theViewer.getViewer().setLightingMode(osg::View::NO_LIGHT);
    return theViewer;
}

support::CameraSpec fromAbove()
{
    return {osg::Matrixd::lookAt(osg::Vec3d(0, 0, 10), osg::Vec3d(), osg::Vec3d(0, 1, 0)),
            osg::Matrixd::ortho(0, PageWidth, 0, PageHeight, 1, 20)};
}

/// 63 different letters that are not blank.
const std::string Letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-";

/// Images of glyphs by CPU, and which of them a picture shows.
class Reader
{
public:
    Reader() : _glyphs(makeGlyphs())
    {
        _codes = _glyphs->codesOf(Letters);
        const CoverageTruth truth(*_glyphs);
        const auto em = float(getEm());
        const glm::mat2 footprint(1.0f / em, 0.0f, 0.0f, 1.0f / em);
        for (const std::uint32_t code : _codes)
        {
            std::vector<float> image;
            for (int y = 0; y < getHeight(); ++y)
                for (int x = 0; x < CellWidth; ++x)
                    image.push_back(truth.getCoverage(
                        {code}, glm::vec2(float(x) + 0.5f, rowOf(y)) / em, footprint));
            _images.push_back(image);
        }
    }

    /// Pixels an em, so that a cell has CellWidth.
    double getEm() const { return CellWidth / double(_glyphs->getCellAdvance()); }

    /// The text of `length` letters whose middle lies there.
    std::string read(const osg::Image& picture, int x, int y, int length) const
    {
        std::string text;
        for (int i = 0; i < length; ++i)
            text += readLetter(picture, x - length * CellWidth / 2 + i * CellWidth, y);
        return text;
    }

private:
    static std::shared_ptr<osgLabels::GlyphSet> makeGlyphs()
    {
        std::string error;
        return std::make_shared<osgLabels::GlyphSet>(osgLabels::FontFace::openOrDefault({}, error));
    }
    int getHeight() const { return 2 * int(getEm() / 2.0) + 2; }
    /// Height of a row of pixels over the line's bottom.
    float rowOf(int y) const { return float(y - getHeight() / 2) + 0.5f + 0.5f * float(getEm()); }

    char readLetter(const osg::Image& picture, int left, int middle) const
    {
        std::vector<float> seen;
        for (int y = 0; y < getHeight(); ++y)
            for (int x = 0; x < CellWidth; ++x)
                seen.push_back(1.0f - picture.getColor(left + x, middle + y - getHeight() / 2).r());
        double best = 1e30;
        char letter = '?';
        for (std::size_t i = 0; i < _images.size(); ++i)
        {
            double distance = 0.0;
            for (std::size_t j = 0; j < seen.size(); ++j)
                distance += (seen[j] - _images[i][j]) * (seen[j] - _images[i][j]);
            if (distance < best)
            {
                best = distance;
                letter = Letters[i];
            }
        }
        // An empty cell is nearest to the thinnest letter; no letter is farther than this.
        return best < 0.02 * double(seen.size()) ? letter : '?';
    }

    std::shared_ptr<osgLabels::GlyphSet> _glyphs;
    std::vector<std::uint32_t> _codes;
    std::vector<std::vector<float>> _images;
};

const Reader& reader()
{
    static const Reader theReader;
    return theReader;
}

/// Boards, each with a text, whose middles lie above each other.
struct Page
{
    static constexpr const char* Settings = "ink=#000000,plate=off,up=y,size=0.8,gap=100";

    Page() = default;
    explicit Page(const std::vector<std::string>& lines) : texts(lines)
    {
        batch = new osgLabels::PrimitiveBatch;
        batch->getOrCreateStateSet()->setMode(GL_LIGHTING, osg::StateAttribute::OFF);
        for (std::size_t i = 0; i < texts.size(); ++i)
        {
            osgLabels::Primitive board;
            board.shape = osgLabels::Shape::Quad;
            board.size = halfSizeOf(texts[i]);
            board.position = osg::Vec3d(PageWidth / 2, middleOf(i), 0.0);
            board.name = texts[i];
            batch->add(board);
        }
        batch->build();
        scene = labelled(batch, Settings);
    }

    /// A text takes at most 0.9 of its room.
    static osg::Vec3 halfSizeOf(const std::string& text)
    {
        return osg::Vec3(float(text.size() * CellWidth) / 1.7f + 4.0f,
                         float(reader().getEm()) / 1.6f, 0.0f);
    }

    /// One more board, not in the batch.
    void add(const std::string& text)
    {
        const osg::Vec3 half = halfSizeOf(text);
        const osg::Vec3 corner =
            osg::Vec3(PageWidth / 2, float(middleOf(texts.size())), 0.0f) - half;
        scene->addChild(named(text, rectangle(corner, {2.0f * half.x(), 0, 0},
                                              {0, 2.0f * half.y(), 0}, {1, 1, 1, 1})));
        texts.push_back(text);
    }

    static int middleOf(std::size_t line) { return RowHeight / 2 + RowHeight * int(line); }

    Picture draw() const
    {
        pageViewer().getViewer().getCamera()->getGraphicsContext()->makeCurrent();
        return pageViewer().render(scene, fromAbove(), PageWidth, PageHeight, 2);
    }

    void expectRead(const std::string& name) const
    {
        const Picture picture = draw();
        ASSERT_TRUE(picture);
        keep(picture, "labelReadBack." + name);
        for (std::size_t i = 0; i < texts.size(); ++i)
            EXPECT_EQ(reader().read(*picture, PageWidth / 2, middleOf(i), int(texts[i].size())),
                      texts[i])
                << name;
    }

    std::vector<std::string> texts;
    osg::ref_ptr<osgLabels::PrimitiveBatch> batch;
    osg::ref_ptr<LabelScene> scene;
};

/// A text of a length, others for other seeds.
std::string textOf(std::size_t length, std::size_t seed)
{
    std::string text;
    for (std::size_t i = 0; i < length; ++i)
        text += Letters[(i * 5 + seed * 7) % Letters.size()];
    return text;
}

class LabelReadBack : public testing::Test
{
protected:
    void SetUp() override { OSGKITS_NEED_GL(pageViewer()); }

    support::NotifyCapture _notify;
};

} // namespace

TEST_F(LabelReadBack, eachGlyphAndEachLength)
{
    for (std::size_t first = 1; first <= 64; first += 8)
    {
        std::vector<std::string> texts;
        for (std::size_t length = first; length < first + 8; ++length)
            texts.push_back(textOf(length, length));
        Page(texts).expectRead("lengths" + std::to_string(first));
    }
    Page({Letters, std::string(Letters.rbegin(), Letters.rend())}).expectRead("letters");
}

TEST_F(LabelReadBack, eachIdentifier)
{
    const std::uint32_t identifiers[] = {1,           255,        256, 65535, 65536, (1u << 24) + 1,
                                         0x7ffffffeu, 0x7fffffffu};
    Page page;
    page.scene = labelled(nullptr, Page::Settings);
    page.scene->getOrCreateStateSet()->setMode(GL_LIGHTING, osg::StateAttribute::OFF);
    for (const std::uint32_t identifier : identifiers)
    {
        if (const auto resources = page.scene->getResources())
        {
            osgLabels::NumberSpace& space = resources->shared->identifiers;
            space.take(identifier - space.getEnd());
        }
        page.add(textOf(10, page.texts.size()));
        ASSERT_TRUE(page.draw());
    }
    page.expectRead("identifiers");
    for (std::size_t i = 0; i < page.texts.size(); ++i)
    {
        page.scene->pick(0.0, 2.0 * Page::middleOf(i) / PageHeight - 1.0);
        ASSERT_TRUE(page.draw());
        const auto picked = page.scene->takePicked();
        ASSERT_TRUE(picked);
        EXPECT_EQ(picked->identifier, identifiers[i]);
        EXPECT_EQ(picked->text, page.texts[i]);
    }
}
