// SPDX-License-Identifier: MIT
// Texts that change 100,000 times a second while they are drawn: for one second, or ten where
// OSGKITS_LONG is set.
#include "LabelPictures.h"

#include <osgLabels/LabelResources.h>
#include <osgLabels/PrimitiveBatch.h>

#include <support/NotifyCapture.h>
#include <support/ResidentMemory.h>

#include <chrono>
#include <cstdlib>
#include <thread>

using namespace labelScene;
using osgLabels::LabelBuffers;
using osgLabels::LabelResources;
using osgLabels::PrimitiveBatch;

namespace
{

constexpr std::uint32_t Objects = 20000, ChangesPerSecond = 100000;
constexpr int Columns = 4, Rows = 6;

using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point start)
{
    return std::chrono::duration<double>(Clock::now() - start).count();
}

double duration()
{
    return std::getenv("OSGKITS_LONG") ? 10.0 : 1.0;
}

/// Some boards in view and many beside it, with these names where they have one.
osg::ref_ptr<PrimitiveBatch> boards(const std::vector<std::string>& names)
{
    osg::ref_ptr<PrimitiveBatch> batch = new PrimitiveBatch;
    batch->getOrCreateStateSet()->setMode(GL_LIGHTING, osg::StateAttribute::OFF);
    for (std::uint32_t i = 0; i < Objects; ++i)
    {
        const int column = int(i) % Columns, row = int(i) / Columns % Rows;
        osgLabels::Primitive board;
        board.shape = osgLabels::Shape::Quad;
        board.size = osg::Vec3(0.3f, 0.14f, 0.0f);
        board.rotation.makeRotate(osg::PI_2, osg::Vec3d(1, 0, 0)); // stands upright
        board.position = osg::Vec3d(0.65 * (column - 1.5), 0.0, 0.32 * (row - 2.5));
        if (i >= Columns * Rows)
            board.position.x() += 100.0 + i;
        board.name = names.empty() ? "T-" + std::to_string(i) : names[i];
        batch->add(board);
    }
    batch->build();
    return batch;
}

std::string textOf(std::uint64_t change)
{
    return std::to_string(change * 7919 % 99991) + (change % 3 ? " bar" : " mbar abs");
}

/// The identifier that a change is of: all in turn, neighbours far apart.
std::uint32_t identifierOf(std::uint64_t change)
{
    return 1 + std::uint32_t(change * 7001 % Objects);
}

/// Makes all changes that are due at each moment, until `total` are made.
void change(osgLabels::LabelScene& scene, std::uint64_t total)
{
    const Clock::time_point start = Clock::now();
    for (std::uint64_t made = 0; made < total;)
    {
        const auto due = std::min(total, std::uint64_t(secondsSince(start) * ChangesPerSecond));
        for (; made < due; ++made)
            if (!scene.setText(identifierOf(made), textOf(made)))
                ADD_FAILURE() << identifierOf(made);
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
}

class LabelChange : public testing::Test
{
protected:
    void SetUp() override { OSGKITS_NEED_GL(viewer()); }

    support::NotifyCapture _notify;
};

} // namespace

TEST_F(LabelChange, aHundredThousandASecondAreUploadedWithoutGrowthAndShown)
{
    const auto batch = boards({});
    const auto scene = labelled(batch, Plain);
    ASSERT_TRUE(render(*scene));
    change(*scene, 2 * Objects); // from names to texts of the length that they will have
    const Picture before = render(*scene);
    const std::shared_ptr<LabelResources> resources = scene->getResources();
    const unsigned int context =
        viewer().getViewer().getCamera()->getGraphicsContext()->getState()->getContextID();
    const auto total = std::uint64_t(duration() * ChangesPerSecond);
    const Clock::time_point start = Clock::now();
    std::thread changes([&] { change(*scene, total); });
    std::size_t sent = 0, frames = 0, most = 0;
    double resident = 0.0;
    while (secondsSince(start) < duration())
    {
        render(*scene, fromFront(), Width, Height, 1);
        const LabelBuffers::Traffic traffic = resources->buffers.getTraffic(context);
        sent += traffic.bytesSent;
        most = std::max(most, traffic.bytesSent);
        ++frames;
        if (resident == 0.0 && secondsSince(start) > duration() / 2)
            resident = support::residentMiB();
    }
    const double residentAtEnd = support::residentMiB();
    changes.join();
    const double seconds = secondsSince(start);
    const Picture after = render(*scene);
    RecordProperty("frames", int(frames));
    RecordProperty("bytesSent", std::to_string(sent));
    std::cout << total << " changes in " << seconds << " s, " << frames << " frames, " << sent
              << " bytes sent, at most " << most << " a frame\n";
    EXPECT_GT(frames, 1u);
    // A change costs its row of 4 bytes and its letters, at most 13 of 6 bits; what lies between
    // two of them may go along.
    EXPECT_LT(sent, total * 64);
    EXPECT_LT(most, LabelBuffers::TextBytesPerFrame + Objects * 8);
    // However many changes: three times the letters that there are at once, and the rows.
    EXPECT_LT(resources->buffers.getTraffic(context).bytesHeld, Objects * (3 * 13 * 6 / 8 + 4));
    // The allocator and the driver keep pools. Each change kept would take 100 bytes and more: 50
    // MB in the second half of ten seconds.
    EXPECT_LT(residentAtEnd, resident + 8.0);

    std::vector<std::string> last(Objects);
    for (std::uint64_t i = total - std::min<std::uint64_t>(total, Objects); i < total; ++i)
        last[identifierOf(i) - 1] = textOf(i);
    std::vector<std::string> names(Objects);
    for (std::uint32_t identifier = 1; identifier <= Objects; ++identifier)
    {
        const unsigned int object = resources->batches.find(identifier).object;
        // Their first names say which of boards() they are.
        names[std::stoul(batch->getObjectName(object).substr(2))] = last[identifier - 1];
    }
    const Picture expected = render(*labelled(boards(names), Plain));
    ASSERT_TRUE(before && after && expected);
    EXPECT_GT(changedShare(*after, *before), 0.02);
    EXPECT_TRUE(areEqual(after, expected, "labelChange.last"));
}
