// SPDX-License-Identifier: MIT
#include "PictureSet.h"

#include "EachCore.h"
#include "PictureFile.h"
#include "PictureSizes.h"

#include <osgDB/fstream>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>

namespace
{

constexpr std::size_t LastBatch = 8;
constexpr int MostTries = 6;
constexpr double GoodEnough = 0.003;

/// A JPEG to be written.
struct Job
{
    Picture* picture;
    double natural;             ///< Pixels.
    double bytesPerPixel = 0.0; ///< Expected.
    double bytes = 0.0;         ///< Written.

    double getExpected() const { return picture->getPixels() * bytesPerPixel; }
};

using Jobs = std::vector<Job>;
using Iterator = Jobs::iterator;

std::string sizeText(double bytes)
{
    char text[32];
    std::snprintf(text, sizeof text, "%.1f MiB", bytes / 1048576.0);
    return text;
}

void writeFile(const std::string& name, const std::vector<std::uint8_t>& bytes)
{
    osgDB::ofstream out(name.c_str(), std::ios::binary);
    out.write(reinterpret_cast<const char*>(bytes.data()), std::streamsize(bytes.size()));
    out.close();
    if (!out)
        throw std::runtime_error("cannot write '" + name + "': is the disk full?");
}

class PictureSet
{
public:
    PictureSet(std::vector<Picture>& pictures, const std::vector<Source>& sources,
               const PictureSettings& settings,
               const std::function<void(const PictureTotals&)>& progress)
        : _sources(sources), _settings(settings), _progress(progress)
    {
        for (Picture& picture : pictures)
        {
            const double natural = naturalPixels(picture);
            setSize(picture, natural);
            if (picture.isJpeg())
                _jobs.push_back({&picture, natural});
            else
                _pngs.push_back(&picture);
        }
        std::stable_sort(_jobs.begin(), _jobs.end(),
                         [](const Job& a, const Job& b) { return a.natural > b.natural; });
    }

    PictureTotals write()
    {
        forEachOnAllCores(_pngs.size(), [this](std::size_t i)
                          { writePng(*_pngs[i], _sources, nameOf(*_pngs[i])); });
        _totals.pngs = unsigned(_pngs.size());
        if (_settings.bytes > 0.0)
            writeToBytes();
        else
            writeBatch(_jobs.begin(), _jobs.end());
        return _totals;
    }

private:
    std::string nameOf(const Picture& picture) const
    {
        return _settings.folder + "/" + picture.file;
    }

    void expect()
    {
        forEachOnAllCores(
            _jobs.size(),
            [this](std::size_t i)
            {
                constexpr int SampledBands = 3, BandRows = 32;
                const Picture& picture = *_jobs[i].picture;
                const int every = std::max(1, picture.rows / (SampledBands * BandRows));
                const double rows = picture.rows / (every * BandRows) * BandRows;
                const auto bytes = encodeJpeg(picture, _sources, _settings.quality, every);
                _jobs[i].bytesPerPixel = double(bytes.size()) / (rows * picture.columns);
            });
    }

    /// Sizes by a factor on the natural ones; what bytes are expected then.
    static double scale(Iterator from, Iterator to, double factor, bool exact)
    {
        double bytes = 0.0;
        for (Iterator job = from; job != to; ++job)
        {
            setSize(*job->picture, job->natural * factor, exact);
            bytes += job->getExpected();
        }
        return bytes;
    }

    static void fit(Iterator from, Iterator to, double bytes, bool exact)
    {
        double low = 1e-6, high = 1e6;
        for (int i = 0; i < 50; ++i)
        {
            const double middle = std::sqrt(low * high);
            (scale(from, to, middle, exact) < bytes ? low : high) = middle;
        }
        scale(from, to, std::sqrt(low * high), exact);
    }

    /// At least one, and none of the last batch, which makes up for the rest.
    Iterator halfOfTheBytes(Iterator from)
    {
        double half = 0.0;
        for (Iterator job = from; job != _jobs.end(); ++job)
            half += 0.5 * job->getExpected();
        const Iterator last = _jobs.end() - std::ptrdiff_t(LastBatch);
        for (double bytes = 0.0; from != last && bytes < half; ++from)
            bytes += from->getExpected();
        return from;
    }

    void checkReach()
    {
        const double least = scale(_jobs.begin(), _jobs.end(), 1e-6, true);
        const double most = scale(_jobs.begin(), _jobs.end(), 1e6, true);
        if (_settings.bytes < least || _settings.bytes > most)
            throw std::runtime_error(std::to_string(_jobs.size()) + " JPEG files of quality " +
                                     std::to_string(_settings.quality) + " have from " +
                                     sizeText(least) + " to " + sizeText(most) + ", not " +
                                     sizeText(_settings.bytes) + "; change --textures");
    }

    void writeToBytes()
    {
        expect();
        checkReach();
        // Again at about the sizes that they get: smaller pictures have more bytes a pixel.
        fit(_jobs.begin(), _jobs.end(), _settings.bytes, false);
        expect();
        double written = 0.0, correction = 1.0;
        Iterator from = _jobs.begin();
        while (std::size_t(_jobs.end() - from) > LastBatch)
        {
            fit(from, _jobs.end(), (_settings.bytes - written) / correction, false);
            const Iterator to = halfOfTheBytes(from);
            const auto [expected, bytes] = writeBatch(from, to);
            written += bytes;
            correction = bytes / expected;
            from = to;
        }
        const PictureTotals before = _totals;
        for (int i = 0; i < MostTries; ++i)
        {
            _totals = before;
            fit(from, _jobs.end(), std::max(1.0, _settings.bytes - written) / correction, true);
            const auto [expected, bytes] = writeBatch(from, _jobs.end());
            if (std::abs(written + bytes - _settings.bytes) < GoodEnough * _settings.bytes)
                return;
            correction = bytes / expected;
        }
    }

    /// Expected bytes and written ones.
    std::pair<double, double> writeBatch(Iterator from, Iterator to)
    {
        forEachOnAllCores(std::size_t(to - from),
                          [&](std::size_t i)
                          {
                              Job& job = from[std::ptrdiff_t(i)];
                              const auto bytes =
                                  encodeJpeg(*job.picture, _sources, _settings.quality);
                              writeFile(nameOf(*job.picture), bytes);
                              job.bytes = double(bytes.size());
                              count(job);
                          });
        std::pair<double, double> sums;
        for (Iterator job = from; job != to; ++job)
        {
            sums.first += job->getExpected();
            sums.second += job->bytes;
        }
        return sums;
    }

    void count(const Job& job)
    {
        const std::lock_guard<std::mutex> lock(_mutex);
        ++_totals.jpegs;
        _totals.bytes += job.bytes;
        _totals.pixels += job.picture->getPixels();
        _progress(_totals);
    }

    const std::vector<Source>& _sources;
    const PictureSettings& _settings;
    const std::function<void(const PictureTotals&)>& _progress;
    Jobs _jobs;
    std::vector<Picture*> _pngs;
    std::mutex _mutex;
    PictureTotals _totals;
};

} // namespace

PictureTotals writePictures(std::vector<Picture>& pictures, const std::vector<Source>& sources,
                            const PictureSettings& settings,
                            const std::function<void(const PictureTotals&)>& progress)
{
    return PictureSet(pictures, sources, settings, progress).write();
}
