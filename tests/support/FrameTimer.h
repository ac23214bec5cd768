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

/// Draws frames without lights of the viewer's own and takes their time.
class FrameTimer
{
public:
    FrameTimer(int width, int height);

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

double median(std::vector<double> values);

/// Rows of numbers, for the terminal and for a CSV file.
class Table
{
public:
    explicit Table(std::vector<std::string> columns) : _columns(std::move(columns)) {}

    /// One value a column; `label` is that of the first column.
    void add(const std::string& label, const std::vector<double>& values);
    void print() const;
    /// An empty name writes nothing; false where the file cannot be written.
    bool write(const std::string& name) const;

private:
    std::vector<std::string> _columns;
    std::vector<std::pair<std::string, std::vector<double>>> _rows;
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
