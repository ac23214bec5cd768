// SPDX-License-Identifier: MIT
// A refinery as a PrimitiveBatch and as a Geometry an object: frames, interleaved; and how long
// files take to load and how much memory they are. Milliseconds of the clock and of all CPUs.
#include <refinery/Drawables.h>
#include <refinery/Refinery.h>

#include <support/HeadlessViewer.h>
#include <support/ResidentMemory.h>

#include <osg/ArgumentParser>
#include <osgDB/ReadFile>
#include <osgUtil/LineSegmentIntersector>

#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cstdio>

namespace
{

constexpr int Width = 1920, Height = 1200;

struct Times
{
    double clock = 1e30, cpu = 1e30;
};

double cpuMilliseconds()
{
    rusage usage;
    getrusage(RUSAGE_SELF, &usage);
    return 1e3 * double(usage.ru_utime.tv_sec + usage.ru_stime.tv_sec) +
           1e-3 * double(usage.ru_utime.tv_usec + usage.ru_stime.tv_usec);
}

/// Keeps the smaller of what is known and what `work` takes: other processes only add.
template <class Work> void measure(Times& times, const Work& work)
{
    const auto start = std::chrono::steady_clock::now();
    const double cpu = cpuMilliseconds();
    work();
    times.cpu = std::min(times.cpu, cpuMilliseconds() - cpu);
    const std::chrono::duration<double, std::milli> clock =
        std::chrono::steady_clock::now() - start;
    times.clock = std::min(times.clock, clock.count());
}

osg::ref_ptr<osgLabels::PrimitiveBatch> batchOf(unsigned int objects)
{
    osg::ref_ptr<osgLabels::PrimitiveBatch> batch = new osgLabels::PrimitiveBatch;
    makeRefinery({objects, 1}, [&](const osgLabels::Primitive& p) { batch->add(p); });
    batch->build();
    return batch;
}

osg::ref_ptr<osg::Group> drawablesOf(unsigned int objects)
{
    Drawables drawables(DrawableLabels::None);
    makeRefinery({objects, 1}, [&](const osgLabels::Primitive& p) { drawables.add(p); });
    return drawables.get();
}

void frames(unsigned int objects, unsigned int mostDrawables, int rounds)
{
    support::HeadlessSettings settings;
    settings.width = Width;
    settings.height = Height;
    settings.smallFeatureCulling = true;
    support::HeadlessViewer viewer(settings);
    if (!viewer.isValid())
    {
        std::fprintf(stderr, "PrimitiveBatchBenchmark: %s\n", viewer.getError().c_str());
        return;
    }
    const auto batch = batchOf(objects);
    const osg::ref_ptr<osg::Group> drawables =
        objects <= mostDrawables ? drawablesOf(objects) : osg::ref_ptr<osg::Group>();
    const double aspect = double(Width) / Height;
    const support::CameraSpec views[] = {
        support::CameraSpec::overview(*batch, aspect),
        support::CameraSpec::perspective({-25.0, -70.0, 28.0}, {0.0, -6.0, 6.0}, {0.0, 0.0, 1.0},
                                         30.0, aspect, 1.0, 5000.0)};
    for (int view = 0; view < 2; ++view)
    {
        Times times[2];
        for (int round = 0; round <= rounds; ++round)
        {
            for (int i = 0; i < (drawables ? 2 : 1); ++i)
            {
                osg::Node* node = i ? static_cast<osg::Node*>(drawables) : batch.get();
                Times unused;
                // The first frames compile and upload.
                viewer.render(node, views[view], Width, Height);
                measure(round ? times[i] : unused,
                        [&] { viewer.render(node, views[view], Width, Height); });
            }
        }
        std::printf("%8u objects, %-8s batch %9.1f ms (CPU %9.1f)", objects,
                    view ? "near" : "overview", times[0].clock, times[0].cpu);
        if (drawables)
            std::printf(", drawables %9.1f ms (CPU %9.1f)", times[1].clock, times[1].cpu);
        std::printf("\n");
    }
}

/// A long line low over the ground, through as much as it can meet.
void pick(osg::Node& node, int rounds)
{
    const osg::BoundingSphere bound = node.getBound();
    const osg::Vec3d along(bound.radius(), 0.3 * bound.radius(), 0.0);
    const osg::Vec3d middle = osg::Vec3d(bound.center().x(), bound.center().y(), 5.0);
    Times times;
    std::size_t hits = 0;
    for (int round = 0; round < rounds; ++round)
    {
        osg::ref_ptr<osgUtil::LineSegmentIntersector> line =
            new osgUtil::LineSegmentIntersector(middle - along, middle + along);
        osgUtil::IntersectionVisitor visitor(line);
        measure(times, [&] { node.accept(visitor); });
        hits = line->getIntersections().size();
    }
    std::printf("a line with %zu hits: %.2f ms (CPU %.2f)\n", hits, times.clock, times.cpu);
}

void load(const std::string& file, int rounds)
{
    const double before = support::residentMiB();
    osg::ref_ptr<osg::Node> node;
    Times times;
    double used = 0.0;
    for (int round = 0; round < rounds; ++round)
    {
        node = nullptr;
        measure(times, [&] { node = osgDB::readRefNodeFile(file); });
        if (round == 0)
            used = support::residentMiB() - before;
    }
    std::printf("%s: %s in %.0f ms (CPU %.0f), %.1f MiB\n", file.c_str(),
                node ? "loaded" : "not loaded", times.clock, times.cpu, used);
    if (node)
        pick(*node, rounds + 2);
}

} // namespace

int main(int argc, char** argv)
{
    osg::ArgumentParser arguments(&argc, argv);
    int rounds = 3, mostDrawables = 100000, most = 1000000;
    arguments.read("--rounds", rounds);
    arguments.read("--most", most);
    arguments.read("--most-drawables", mostDrawables);
    bool loaded = false;
    for (int i = 1; i < arguments.argc(); ++i, loaded = true)
        load(arguments[i], rounds);
    for (int objects = 1000; !loaded && objects <= most; objects *= 10)
        frames(unsigned(objects), unsigned(mostDrawables), rounds);
    return 0;
}
