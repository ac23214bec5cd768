// SPDX-License-Identifier: MIT
// What readers of a table are sent while it changes.
#include "LabelCodes.h"
#include "TableMirror.h"

#include <gtest/gtest.h>

#include <atomic>
#include <map>
#include <random>
#include <thread>

using osgLabels::LabelTable;
using Codes = LabelTable::Codes;

TEST(LabelTableReaderTest, aChangeSendsItsRowAndItsTextOnly)
{
    LabelTable table;
    for (std::uint32_t id = 1; id <= 10000; ++id)
        table.setCodes(id, tag(id));
    TableMirror mirror(table);
    mirror.take();
    table.setCodes(5000, tag(123456));
    mirror.take();
    EXPECT_EQ(mirror.codesOf(5000), tag(123456));
    EXPECT_LE(mirror.calls, 2u);
    EXPECT_LE(mirror.sent, 4u + 20u); // 120 bits touch at most 5 words
    mirror.take();
    EXPECT_EQ(mirror.sent, 0u);
    table.setCodes(5000, tag(123456)); // the same
    mirror.take();
    EXPECT_EQ(mirror.sent, 0u);
}

TEST(LabelTableReaderTest, aReaderThatNeverTakesDoesNotMakeItGrow)
{
    LabelTable table;
    TableMirror idle(table), busy(table);
    table.setCodes(1, tag(1));
    idle.take();
    busy.take();
    for (std::uint32_t i = 0; i < 300'000; ++i)
    {
        table.setCodes(1 + i % 1000, tag(i));
        if (i % 1000 == 0)
            busy.take(4096);
    }
    EXPECT_LE(table.getSizes().textBytes, std::size_t(1) << 20);
    EXPECT_LE(table.getSizes().mainBytes, std::size_t(8) << 20);
    idle.take(16);
    for (std::uint32_t id = 1; id <= 1000; ++id)
        ASSERT_EQ(idle.codesOf(id), table.getCodes(id));
}

TEST(LabelTableReaderTest, changesForEverReuseFreedSpace)
{
    LabelTable table;
    table.reserveCodes(62);
    std::mt19937 random(7);
    TableMirror mirror(table);
    std::size_t early = 0;
    for (int round = 0; round < 1000; ++round)
    {
        for (std::uint32_t id = 1; id <= 500; ++id)
            table.setCodes(id, sequence(1 + random() % 40, random() % 63, 63));
        if (round % 3)
            mirror.take();
        if (round == 50)
            early = table.getSizes().textBytes;
    }
    EXPECT_GT(early, 500u * 10);
    // Two generations at most are alive at a time, and the limit of what may wait for readers.
    EXPECT_LE(table.getSizes().textBytes, 2 * early);
}

TEST(LabelTableReaderTest, toggledThousandTimesItKeepsItsSize)
{
    LabelTable table;
    TableMirror mirror(table);
    LabelTable::Sizes first;
    for (int round = 0; round < 1000; ++round)
    {
        for (std::uint32_t id = 1; id <= 100; ++id)
            table.setCodes(id, tag(id));
        mirror.take();
        for (std::uint32_t id = 1; id <= 100; ++id)
            table.remove(id);
        mirror.take();
        if (round == 2)
            first = table.getSizes();
    }
    EXPECT_EQ(table.getSizes().mainBytes, first.mainBytes);
    EXPECT_EQ(table.getSizes().textBytes, first.textBytes);
    EXPECT_EQ(table.getSizes().labels, 0u);
}

TEST(LabelTableReaderTest, inPartsEachLabelShowsATextOfItsOwn)
{
    LabelTable table;
    TableMirror mirror(table);
    table.reserveCodes(62);
    std::mt19937 random(11);
    constexpr std::uint32_t count = 2000;
    unsigned int partial = 0;
    for (int frame = 0; frame < 400; ++frame)
    {
        for (int i = 0; i < 300; ++i)
        {
            // The first two codes say whose text it is.
            const std::uint32_t id = 1 + random() % count;
            Codes codes = sequence(2 + random() % 80, random() % 63, 63);
            codes[0] = id / 63;
            codes[1] = id % 63;
            table.setCodes(id, random() % 4 ? codes : Codes());
        }
        mirror.take(frame % 5 ? 2000 : 1 << 20); // about 8000 bytes change in a frame
        partial += mirror.sent == 2000;
        for (std::uint32_t id = 1; id <= count; ++id)
        {
            const Codes shown = mirror.codesOf(id);
            ASSERT_TRUE(shown.empty() || (shown.size() >= 2 && shown[0] * 63 + shown[1] == id))
                << "identifier " << id << " in frame " << frame;
        }
    }
    EXPECT_GT(partial, 200u);
    mirror.take();
    for (std::uint32_t id = 1; id <= count; ++id)
        ASSERT_EQ(mirror.codesOf(id), table.getCodes(id));
}

TEST(LabelTableReaderTest, buffersThatLoseTheirContentAreSentAnew)
{
    LabelTable table;
    TableMirror mirror(table);
    mirror.losesContent = true;
    for (std::uint32_t id = 1; id <= 5000; ++id)
    {
        table.setCodes(id, tag(id));
        if (id % 100)
            continue;
        mirror.take(16);
        for (std::uint32_t earlier = 1; earlier < id; earlier += 50)
        {
            const Codes shown = mirror.codesOf(earlier);
            ASSERT_TRUE(shown.empty() || shown == tag(earlier)) << earlier << " of " << id;
        }
    }
    mirror.take();
    for (std::uint32_t id = 1; id <= 5000; ++id)
        ASSERT_EQ(mirror.codesOf(id), tag(id));
}

TEST(LabelTableReaderTest, randomChangesReadBackDenseAndSparse)
{
    for (const std::uint32_t spread : {1u, 3u, 7u, 100'003u})
    {
        LabelTable table;
        TableMirror mirror(table);
        std::mt19937 random(spread);
        std::map<std::uint32_t, Codes> texts;
        std::map<std::uint32_t, std::uint32_t> styles;
        for (int step = 0; step < 60'000; ++step)
        {
            const std::uint32_t id = 1 + random() % 5000 * spread;
            switch (random() % 8)
            {
            case 0:
                table.remove(id);
                texts.erase(id);
                styles.erase(id);
                break;
            case 1:
                styles[id] = random() % 5;
                table.setStyle(id, styles[id]);
                break;
            default:
                texts[id] = sequence(random() % 100, random() % 63, 63);
                table.setCodes(id, texts[id]);
            }
            if (random() % 1000 == 0)
                mirror.take();
        }
        mirror.take();
        for (std::uint32_t i = 0; i < 5000; ++i)
        {
            const std::uint32_t id = 1 + i * spread;
            ASSERT_EQ(mirror.codesOf(id), texts[id]) << id;
            ASSERT_EQ(table.getCodes(id), texts[id]) << id;
            ASSERT_EQ(mirror.styleOf(id), styles[id]) << id;
        }
        if (spread != 3) // 3 may be either, by the order of insertion
        {
            EXPECT_EQ(mirror.isSparse(), spread > 4) << spread;
        }
    }
}

TEST(LabelTableReaderTest, threadsMaySetWhileAnotherTakes)
{
    LabelTable table;
    table.reserveCodes(62);
    TableMirror mirror(table);
    std::atomic<int> running{3};
    std::vector<std::thread> threads;
    for (std::uint32_t t = 0; t < 3; ++t)
        threads.emplace_back(
            [&, t]
            {
                for (std::uint32_t i = 0; i < 30'000; ++i)
                    table.setCodes(1 + t * 1000 + i % 1000, tag(i));
                --running;
            });
    while (running)
        mirror.take(10'000);
    for (std::thread& thread : threads)
        thread.join();
    mirror.take();
    for (std::uint32_t id = 1; id <= 3000; ++id)
        ASSERT_EQ(mirror.codesOf(id), tag(29'000 + (id - 1) % 1000));
}
