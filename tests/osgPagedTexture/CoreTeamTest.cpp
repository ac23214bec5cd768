// SPDX-License-Identifier: MIT
#include <osgPagedTexture/CoreTeam.h>

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <string>
#include <vector>

namespace
{

using osgPagedTexture::CoreTeam;

TEST(CoreTeamTest, everyPartIsDoneOnceAndNoMemberDoesTwoAtATime)
{
    for (unsigned int size : {1u, 2u, 5u})
    {
        CoreTeam team(size);
        EXPECT_EQ(team.getSize(), size);
        std::vector<std::atomic<int>> busy(size);
        for (std::size_t count : {0u, 1u, 3u, 1000u})
        {
            std::vector<std::atomic<int>> done(count);
            team.run(count,
                     [&](std::size_t part, unsigned int member)
                     {
                         ASSERT_LT(member, size);
                         EXPECT_EQ(busy[member]++, 0);
                         ++done[part];
                         --busy[member];
                     });
            for (const std::atomic<int>& times : done)
                EXPECT_EQ(times, 1);
        }
    }
}

TEST(CoreTeamTest, theFirstPartsExceptionIsThrownAndTheTeamWorksOn)
{
    CoreTeam team(3);
    for (int round = 0; round < 200; ++round)
    {
        try
        {
            team.run(100,
                     [](std::size_t part, unsigned int)
                     {
                         if (part >= 7)
                             throw std::runtime_error(std::to_string(part));
                     });
            ADD_FAILURE() << "nothing was thrown";
        }
        catch (const std::runtime_error& error)
        {
            // Parts are begun in order, so that part 7 is always among those that are.
            EXPECT_EQ(error.what(), std::string("7"));
        }
        std::atomic<int> done{0};
        team.run(10, [&](std::size_t, unsigned int) { ++done; });
        EXPECT_EQ(done, 10);
    }
}

} // namespace
