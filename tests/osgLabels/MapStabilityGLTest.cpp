// SPDX-License-Identifier: MIT
// Map labels along a recorded path over a town: how often they come and go.
#include "MapFlight.h"

#include <gtest/gtest.h>

#include <cstdlib>

namespace
{

class MapStabilityGLTest : public testing::Test
{
protected:
    void SetUp() override { OSGKITS_NEED_GL(cityPictures::viewer()); }

    static const City& town()
    {
        static const City theTown = cityPictures::makeTown();
        return theTown;
    }

    static MapFlight::Flips report(const std::string& what, const MapFlight::Flips& flips)
    {
        std::printf("%s: %u frames, %.1f labels shown, %u flips, %.4f a label and second, "
                    "at most %u of one in a second\n",
                    what.c_str(), flips.frames, flips.shown, flips.count, flips.perLabelAndSecond,
                    flips.most);
        return flips;
    }
};

const bool isLong = std::getenv("OSGKITS_LONG") != nullptr;
const double Seconds = isLong ? 30.0 : 3.0;

} // namespace

TEST_F(MapStabilityGLTest, aLabelChangesOnceASecondAtMostWhileTheCameraMovesSlowly)
{
    // A quarter of the path's speed: 4 to 9 m/s; in three seconds of that nothing would change.
    MapFlight flight(town(), "maptest=share", true);
    const auto flips = report("slow, with a past", flight.fly(8.0, Seconds, isLong ? 0.25 : 0.5));
    EXPECT_LE(flips.most, 1u);
    EXPECT_GT(flips.count, 0u);
    EXPECT_GT(flips.shown, 5.0);
}

TEST_F(MapStabilityGLTest, aPastMakesLabelsChangeLessOften)
{
    MapFlight with(town(), "maptest=share", true), without(town(), "maptest=share", false);
    const auto calm = report("with a past", with.fly(8.0, Seconds, 1.0)),
               nervous = report("without", without.fly(8.0, Seconds, 1.0));
    EXPECT_GT(nervous.count, isLong ? 100u : 10u);
    EXPECT_LT(calm.count, 0.8 * nervous.count);
    EXPECT_LE(calm.most, 2u);
    EXPECT_GT(calm.shown, 0.7 * nervous.shown) << "nothing is bought by showing less";
}

TEST_F(MapStabilityGLTest, atRestNothingChanges)
{
    const std::vector<std::string> tests = {"maptest=share", "maptest=anchor", "maptest=pixel"};
    const std::vector<double> stops = {36.0, 13.0, 2.0, 9.0, 17.0, 25.0};
    for (std::size_t i = 0; i < (isLong ? tests.size() : 1); ++i)
    {
        MapFlight flight(town(), tests[i], true);
        for (std::size_t stop = 0; stop < (isLong ? stops.size() : 2); ++stop)
        {
            flight.fly(stops[stop], 1.0, 1.0);
            // Longer than the second that changes are held back for.
            EXPECT_EQ(flight.rest(isLong ? 50 : 15), 0u)
                << tests[i] << " at second " << stops[stop];
        }
    }
}
