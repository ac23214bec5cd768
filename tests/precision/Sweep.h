// SPDX-License-Identifier: MIT
#pragma once

#include <osg/Image>
#include <osg/ref_ptr>

#include <functional>
#include <string>
#include <vector>

namespace precision
{

/// What one run of a method gives: a picture or a number.
struct Outcome
{
    osg::ref_ptr<osg::Image> picture;
    double number = 0.0;
    double seconds =
        -1.0; ///< What the run measured of itself; below 0: the harness's clock counts.
};

/// One line of a work-precision diagram: a method and the values of its knob.
struct Method
{
    std::string name;
    std::string knob; ///< What the values are, e.g. "grid" or "samples a side".
    std::vector<double> values;
    /// Called once a round for each value, always from one thread. Throws what derives from
    /// std::exception when it fails: the pair is then kept as a failure and not run again.
    std::function<Outcome(double value)> run;
};

/// Methods that answer one question at different cost, with a common ground truth.
struct Sweep
{
    std::string name; ///< Of its files: [a-z0-9-]+.
    std::string title;
    std::string errorName;                  ///< Of the error axis, with its unit.
    std::function<Outcome()> makeReference; ///< Called once, untimed; may be empty.
    std::function<double(const Outcome& outcome, const Outcome& reference)>
        getError; ///< 0 or more.
    std::vector<Method> methods;
    std::string renderer; ///< GL renderer string, or what else did the work.
    bool errorEachRound =
        false;              ///< Else the first round's error counts; the mean of all otherwise.
    std::string budgetName; ///< What all knobs are, with the unit, where the diagram is to show the
                            ///< error over that; else it shows the run time over the error.
};

/// A sweep of the program: one static object in the file of the sweep. The factory is called only
/// when the sweep is run.
class Registration
{
public:
    Registration(const std::string& name, std::function<Sweep()> makeSweep);
};

struct Entry
{
    std::string name;
    std::function<Sweep()> makeSweep;
};

/// All registered sweeps, by name.
const std::vector<Entry>& getSweeps();

} // namespace precision
