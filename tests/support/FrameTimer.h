// SPDX-License-Identifier: MIT
#pragma once

#include <support/HeadlessViewer.h>

#include <osg/ArgumentParser>

#include <functional>
#include <string>
#include <utility>
#include <vector>

/// Milliseconds of one frame.
struct FrameTime
{
    double frame = 0.0; ///< From its begin until its picture can be read.
    double cull = 0.0;  ///< Of it, the cull traversal.
};

/// What every benchmark takes from its command line.
struct BenchmarkOptions
{
    int width = 640, height = 480; ///< --size WxH
    int rounds = 7;                ///< --rounds N, after one that does not count
    std::string csv;               ///< --csv file

    /// False, and a line on the error stream, where a size is none.
    bool read(osg::ArgumentParser& arguments);
};

/// Draws frames without lights of the viewer's own and takes their time.
class FrameTimer
{
public:
    explicit FrameTimer(const BenchmarkOptions& options);

    /// False where there is no context, which the error stream was told.
    bool isValid() const { return _viewer.isValid(); }
    support::HeadlessViewer& getViewer() { return _viewer; }
    double getAspect() const { return double(_width) / _height; }

    /// Time of one frame after an untimed one of the same scene; `change` is called in between.
    FrameTime draw(osg::Node& scene, const support::CameraSpec& camera,
                   const std::function<void()>& change = {});
    /// Time of one frame, whatever was drawn before.
    FrameTime drawOnce(osg::Node& scene, const support::CameraSpec& camera);

private:
    int _width, _height;
    support::HeadlessViewer _viewer;
};

/// CPU time of all threads of the program: others may keep a machine busy.
double getCpuMilliseconds();

double median(std::vector<double> values);

/// Appends the median of each of several series to a row.
template <class Series> void addMedians(std::vector<double>& row, const Series& series)
{
    for (const std::vector<double>& values : series)
        row.push_back(median(values));
}

/// Rows of numbers, for the terminal and for a CSV file.
class Table
{
public:
    explicit Table(std::vector<std::string> columns) : _columns(std::move(columns)) {}

    /// One value a column; `label` is that of the first column.
    void add(const std::string& label, const std::vector<double>& values);
    /// Prints it, and writes it where a file is named. The exit status of a benchmark: 1, and a
    /// line on the error stream, where the file can't be written.
    int report(const std::string& csv) const;

private:
    void print() const;
    bool write(const std::string& name) const;

    std::vector<std::string> _columns;
    std::vector<std::pair<std::string, std::vector<double>>> _rows;
};
