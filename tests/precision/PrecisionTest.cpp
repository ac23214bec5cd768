// SPDX-License-Identifier: MIT
#include <precision/ImageError.h>
#include <precision/Measure.h>
#include <precision/Report.h>

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>
#include <stdexcept>

namespace
{

using precision::Outcome;

/// Two methods that note each run; the seconds they claim are the number of the run.
struct Notebook
{
    std::string runs;
    int count = 0;

    precision::Method makeMethod(const std::string& name, std::vector<double> values)
    {
        return {name, "n", std::move(values),
                [this, name](double value)
                {
                    runs += name + std::to_string(static_cast<int>(value)) + ' ';
                    Outcome outcome;
                    outcome.number = value;
                    outcome.seconds = ++count;
                    return outcome;
                }};
    }

    precision::Sweep makeSweep()
    {
        precision::Sweep sweep;
        sweep.name = "test";
        sweep.title = "A \"test\"";
        sweep.errorName = "distance to 10";
        sweep.renderer = "none";
        sweep.makeReference = []
        {
            Outcome reference;
            reference.number = 10.0;
            return reference;
        };
        sweep.getError = [](const Outcome& outcome, const Outcome& reference)
        { return std::fabs(outcome.number - reference.number); };
        sweep.methods = {makeMethod("a", {1, 2}), makeMethod("b", {3})};
        return sweep;
    }
};

TEST(PrecisionTest, quantilesLieBetweenNeighbours)
{
    EXPECT_EQ(precision::getQuantile({}, 0.5), 0.0);
    EXPECT_EQ(precision::getQuantile({7.0}, 0.9), 7.0);
    EXPECT_EQ(precision::getQuantile({3.0, 1.0, 2.0}, 0.5), 2.0);
    EXPECT_EQ(precision::getQuantile({4.0, 1.0, 3.0, 2.0}, 0.5), 2.5);
    EXPECT_DOUBLE_EQ(precision::getQuantile({0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10}, 0.1), 1.0);
    EXPECT_EQ(precision::getQuantile({1.0, 2.0}, 1.0), 2.0);
}

TEST(PrecisionTest, roundsGoRoundAllPairsAndWarmUpsAreNotTimed)
{
    Notebook notebook;
    const auto measurements = precision::measure(notebook.makeSweep(), {2, 1});
    EXPECT_EQ(notebook.runs, "a1 a2 b3 a1 a2 b3 a1 a2 b3 ");
    ASSERT_EQ(measurements.size(), 3u);
    EXPECT_EQ(measurements[0].seconds, (std::vector<double>{4.0, 7.0}));
    EXPECT_EQ(measurements[2].seconds, (std::vector<double>{6.0, 9.0}));
    EXPECT_EQ(measurements[1].error, 8.0);
}

TEST(PrecisionTest, theClockCountsWhereARunDoesNot)
{
    precision::Sweep sweep = Notebook().makeSweep();
    sweep.methods = {{"m", "n", {1}, [](double) { return Outcome(); }}};
    const auto measurements = precision::measure(sweep, {3, 0});
    ASSERT_EQ(measurements[0].seconds.size(), 3u);
    EXPECT_GE(measurements[0].seconds[0], 0.0);
    EXPECT_LT(measurements[0].seconds[0],
              5.0); // a run does nothing: seconds would be another clock's
}

TEST(PrecisionTest, theErrorIsThatOfTheFirstRoundOrTheMeanOfAllWhereAsked)
{
    Notebook notebook;
    precision::Sweep sweep = notebook.makeSweep();
    sweep.getError = [](const Outcome& outcome, const Outcome&) { return outcome.seconds; };
    sweep.methods.pop_back();
    EXPECT_EQ(precision::measure(sweep, {3, 0})[0].error, 1.0);
    notebook.count = 0;
    sweep.errorEachRound = true;
    EXPECT_EQ(precision::measure(sweep, {3, 0})[0].error, 3.0); // 1, 3, 5
}

TEST(PrecisionTest, aRunThatFailsIsKeptAsAFailureAndTheOthersGoOn)
{
    Notebook notebook;
    precision::Sweep sweep = notebook.makeSweep();
    int runs = 0;
    sweep.methods.insert(sweep.methods.begin() + 1, {"bad",
                                                     "n",
                                                     {5},
                                                     [&runs](double) -> Outcome
                                                     {
                                                         ++runs;
                                                         throw std::runtime_error("no, \"never\"");
                                                     }});
    sweep.methods.push_back({"nan",
                             "n",
                             {6},
                             [](double)
                             {
                                 Outcome outcome;
                                 outcome.number = std::nan("");
                                 return outcome;
                             }});
    const auto measurements = precision::measure(sweep, {2, 0});
    ASSERT_EQ(measurements.size(), 5u);
    EXPECT_EQ(measurements[2].failure, "no, \"never\"");
    EXPECT_EQ(runs, 1);
    EXPECT_EQ(measurements[3].seconds.size(), 2u);
    EXPECT_EQ(measurements[4].failure, "the error is not finite");

    std::ostringstream csv;
    precision::writeCsv(csv, sweep, measurements);
    EXPECT_NE(csv.str().find("bad,n,5,failed,,,,,0,\"no, \"\"never\"\"\"\n"), std::string::npos);
    std::ostringstream plot;
    precision::writePlot(plot, sweep, measurements, "x.svg");
    EXPECT_NE(plot.str().find("\"bad, n 5: failed\""), std::string::npos);
    std::ostringstream table;
    precision::printTable(table, sweep, measurements);
    EXPECT_NE(table.str().find("FAILED: no, \"never\""), std::string::npos);
}

TEST(PrecisionTest, csvLinesHoldMilliseconds)
{
    precision::Measurement measurement{"a, b", "n", 2.0, 0.25, {0.001, 0.003, 0.002}, ""};
    std::ostringstream csv;
    const precision::Sweep sweep = Notebook().makeSweep();
    precision::writeCsv(csv, sweep, {measurement});
    EXPECT_EQ(csv.str(),
              "# A \"test\"\n# error: distance to 10\n# machine: " + precision::describeMachine() +
                  "\n# renderer: none\n"
                  "method,knob,value,status,error,median_ms,p10_ms,p90_ms,rounds,message\n"
                  "\"a, b\",n,2,ok,0.25,2,1.2,2.8,3,\n");
}

osg::ref_ptr<osg::Image> makePicture(int size, float value)
{
    osg::ref_ptr<osg::Image> picture = new osg::Image;
    picture->allocateImage(size, size, 1, GL_RGBA, GL_FLOAT);
    std::fill_n(reinterpret_cast<float*>(picture->data()), 4 * size * size, value);
    return picture;
}

TEST(PrecisionTest, imageErrorsAreThoseOfTheThreeColours)
{
    const osg::ref_ptr<osg::Image> expected = makePicture(2, 0.5f), actual = makePicture(2, 0.5f);
    auto* const pixel = reinterpret_cast<float*>(actual->data(1, 0));
    pixel[0] = 1.0f;
    pixel[3] = 9.0f; // alpha does not count
    const precision::ImageError error = precision::getImageError(*actual, *expected);
    EXPECT_DOUBLE_EQ(error.rms, std::sqrt(0.25 / 12.0));
    EXPECT_DOUBLE_EQ(error.max, 0.5);
    EXPECT_DOUBLE_EQ(error.meanAbsolute, 0.5 / 12.0);
    EXPECT_DOUBLE_EQ(error.shareOver, 0.25);
    EXPECT_THROW(precision::getImageError(*actual, *makePicture(3, 0.0f)), std::runtime_error);
    pixel[1] = std::nanf("");
    EXPECT_TRUE(std::isnan(precision::getImageError(*actual, *expected).max));
    EXPECT_DOUBLE_EQ(precision::getImageError(*actual, *expected).shareOver, 0.25);
}

TEST(PrecisionTest, boxFilterAveragesBlocks)
{
    const osg::ref_ptr<osg::Image> large = makePicture(4, 0.0f);
    reinterpret_cast<float*>(large->data(2, 1))[0] = 8.0f;
    const osg::ref_ptr<osg::Image> small = precision::boxFilter(*large, 2);
    ASSERT_EQ(small->s(), 2);
    EXPECT_EQ(reinterpret_cast<const float*>(small->data(1, 0))[0], 2.0f);
    EXPECT_EQ(reinterpret_cast<const float*>(small->data(0, 0))[0], 0.0f);
    EXPECT_THROW(precision::boxFilter(*large, 3), std::runtime_error);
}

} // namespace
