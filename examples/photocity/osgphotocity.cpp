// SPDX-License-Identifier: MIT
#include "Inventor.h"
#include "PictureSet.h"
#include "Town.h"

#include <examples/commandline/CommandLine.h>

#include <osg/MatrixTransform>
#include <osgDB/FileNameUtils>
#include <osgDB/WriteFile>
#include <osgDB/fstream>

#include <charconv>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <map>
#include <stdexcept>
#include <string>

#ifdef _WIN32
#include <io.h>
#define isatty _isatty
#define fileno _fileno
#else
#include <unistd.h>
#endif

namespace
{

constexpr unsigned int MostTextures = 50000, MostSources = 24;
constexpr double BytesPerTexture = 550.0 * 1024.0;

struct Command
{
    TownSettings town;
    PictureSettings pictures;
    std::vector<std::string> photos;
    std::string file, path;
};

int fail(const std::string& message)
{
    std::fprintf(stderr, "osgphotocity: %s\n", message.c_str());
    return 1;
}

/// Bytes, such as 1.5GiB; makes a plain number of them.
CLI::Validator sizeWithUnit()
{
    const double KiB = 1024.0;
    const std::map<std::string, double> units = {
        {"KiB", KiB}, {"MiB", KiB * KiB}, {"GiB", KiB * KiB * KiB}, {"TiB", KiB * KiB * KiB * KiB}};
    return CLI::Validator(
        [units](std::string& text)
        {
            const std::string given = text;
            try
            {
                if (CLI::AsNumberWithUnit(units)(text).empty() &&
                    examples::between(1.0, 1e15)(text).empty())
                    return std::string();
            }
            catch (const CLI::ValidationError&) // what it says names types
            {
            }
            return "needs a size such as 1.5GiB, 200MiB, 64KiB or 1000000, not '" + given + "'";
        },
        std::string());
}

void declare(examples::CommandLine& line, Command& command)
{
    line.addFile(command.file, ".osgb, .osgt, .ive, .obj, .iv");
    CLI::Option* textures = line.addNumber("--textures", command.town.textures, 1u, MostTextures,
                                           "how many JPEG files; with --bytes one for 550 KiB");
    line.add_option("--bytes", command.pictures.bytes,
                    "of all JPEG files together, such as 1.5GiB or 200MiB;\n"
                    "sizes are chosen for it")
        ->transform(sizeWithUnit())
        ->type_name("SIZE");
    line.addNumber("--quality", command.pictures.quality, 1, 100, "of the JPEG files");
    line.add_option("--photos", command.photos,
                    "folder of photographs to cut from; may be repeated; default:\n"
                    "/usr/share/backgrounds and /usr/share/wallpapers, and where\n"
                    "there are none, patterns of noise")
        ->expected(1)
        ->take_all()
        ->type_name("DIR");
    line.add_option("--path", command.path,
                    "also writes a flight through the streets, as osgviewer -p\nreads it")
        ->type_name("FILE");
    line.addNumber("--seed", command.town.seed, 0u, ~0u, "another number gives another town");
    line.callback(
        [&command, textures]
        {
            if (!*textures && command.pictures.bytes > 0.0)
                command.town.textures = unsigned(std::min(
                    std::ceil(command.pictures.bytes / BytesPerTexture), double(MostTextures)));
        });
}

/// One line that is written over, where somebody looks.
class ProgressLine
{
public:
    explicit ProgressLine(unsigned int count) : _count(count) {}
    ~ProgressLine()
    {
        if (_shown)
            std::fputs("\r\033[K", stderr);
    }
    void operator()(const PictureTotals& totals)
    {
        const auto now = std::chrono::steady_clock::now();
        if (!isatty(fileno(stderr)) || now - _last < std::chrono::milliseconds(200))
            return;
        _last = now;
        _shown = true;
        std::fprintf(stderr, "\r%u of %u photographs, %.0f MiB, %.0f s ", totals.jpegs, _count,
                     totals.bytes / 1048576.0, std::chrono::duration<double>(now - _start).count());
    }

private:
    unsigned int _count;
    bool _shown = false;
    std::chrono::steady_clock::time_point _start = std::chrono::steady_clock::now(), _last;
};

std::vector<Source> sourcesOf(const Command& command)
{
    const bool named = !command.photos.empty();
    std::vector<Source> sources =
        readSources(named ? command.photos : systemPhotoFolders(), MostSources, command.town.seed);
    if (!sources.empty())
        return sources;
    if (named)
        throw std::runtime_error("no photograph of at least 640 pixels a side is in '" +
                                 command.photos.front() + "'; name a folder of JPEG or PNG files");
    std::fprintf(stderr, "osgphotocity: no photographs are installed, so patterns of noise are "
                         "used; install for instance mate-backgrounds, or name --photos\n");
    return makeSources(command.town.seed);
}

/// The folder for the pictures, made and with room for them.
void prepareFolder(const std::filesystem::path& folder, double bytes)
{
    std::error_code failure;
    std::filesystem::create_directories(folder, failure);
    if (failure)
        throw std::runtime_error("cannot make the folder '" + folder.string() +
                                 "': " + failure.message());
    const auto space = std::filesystem::space(folder, failure);
    if (!failure && double(space.available) < 1.02 * bytes)
        throw std::runtime_error("the disk of '" + folder.string() +
                                 "' has not enough room; make room or lessen --bytes");
}

void writeFlight(const Town& town, const Command& command)
{
    osgDB::ofstream out(command.path.c_str(), std::ios::binary);
    out.precision(9);
    makeFlight(town, command.town.seed)->write(out);
    if (!out.flush())
        throw std::runtime_error("cannot write '" + command.path + "'; does its folder exist?");
}

bool writeModel(osg::Node& town, const std::string& file)
{
    const std::string ending = osgDB::getLowerCaseFileExtension(file);
    if (ending == "iv")
        return writeInventor(town, file);
    if (ending != "obj")
        return osgDB::writeNodeFile(town, file);
    // OSG's reader takes y for up, and its writer leaves all as it is.
    osg::ref_ptr<osg::MatrixTransform> turned =
        new osg::MatrixTransform(osg::Matrix::rotate(-osg::PI_2, osg::X_AXIS));
    turned->addChild(&town);
    return osgDB::writeNodeFile(*turned, file);
}

void make(Command& command)
{
    const std::string ending = osgDB::getLowerCaseFileExtension(command.file);
    // Found out before minutes are spent on pictures.
    if (ending != "iv" && !osgDB::Registry::instance()->getReaderWriterForExtension(ending))
        throw std::runtime_error("cannot write '" + command.file + "': no plugin for its ending");
    const std::filesystem::path file(command.file);
    if (!file.parent_path().empty() && !std::filesystem::is_directory(file.parent_path()))
        throw std::runtime_error("cannot write '" + command.file + "': no such folder");
    command.town.folder = file.stem().string() + "_photos";
    Town town = makeTown(command.town);
    if (!command.path.empty())
        writeFlight(town, command);
    command.pictures.folder = file.has_parent_path() ? file.parent_path().string() : ".";
    prepareFolder(file.parent_path() / command.town.folder, command.pictures.bytes);
    PictureTotals totals;
    {
        const std::vector<Source> sources = sourcesOf(command);
        ProgressLine line(command.town.textures);
        totals = writePictures(town.pictures, sources, command.pictures,
                               [&](const PictureTotals& now) { line(now); });
    }
    if (!writeModel(*town.scene, command.file))
        throw std::runtime_error("cannot write '" + command.file + "'");
    std::printf("%s: %u JPEG files, %.1f MiB, %.1f megapixels; %u PNG files; seed %u\n",
                command.file.c_str(), totals.jpegs, totals.bytes / 1048576.0, totals.pixels * 1e-6,
                totals.pngs, command.town.seed);
}

} // namespace

int main(int argc, char** argv)
{
    Command command;
    examples::CommandLine line(
        "Writes a generated town whose facades, roofs, squares and streets have a photograph each, "
        "and the\n"
        "photographs: JPEG files, all different, of 512 to 8192 pixels a side, many of odd sizes, "
        "some grey,\n"
        "some progressive; PNG with alpha for fences and trees; a few normal maps, in texture unit "
        "1. They\n"
        "are cut from the photographs that are installed: turned, scaled, in other colours. The "
        "pictures lie\n"
        "in a folder beside the file, FILE without its ending and _photos. Metres, z is up.",
        "osgphotocity");
    declare(line, command);
    if (const auto status = line.read(argc, argv))
        return *status;
    try
    {
        make(command);
    }
    catch (const std::exception& error)
    {
        return fail(error.what());
    }
    return 0;
}
