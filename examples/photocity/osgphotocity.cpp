// SPDX-License-Identifier: MIT
#include "Inventor.h"
#include "PictureSet.h"
#include "Town.h"

#include <osg/MatrixTransform>
#include <osgDB/FileNameUtils>
#include <osgDB/WriteFile>
#include <osgDB/fstream>

#include <charconv>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <limits>
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

constexpr char Help[] =
    R"(osgphotocity [options] FILE
Writes a generated town whose facades, roofs, squares and streets have a photograph each, and the
photographs: JPEG files, all different, of 512 to 8192 pixels a side, many of odd sizes, some grey,
some progressive; PNG with alpha for fences and trees; a few normal maps, in texture unit 1. They
are cut from the photographs that are installed: turned, scaled, in other colours. The ending says
the format: .osgb, .osgt, .ive, .obj, .iv. The pictures lie in a folder beside it, FILE without its
ending and _photos. Metres, z is up.

  --textures N   how many JPEG files, 1 to 50000; default 200, with --bytes one for 550 KiB
  --bytes B      of all JPEG files together, such as 1.5GiB or 200MiB; sizes are chosen for it
  --quality N    of the JPEG files, 1 to 100; default 90
  --photos DIR   photographs to cut from; may be repeated; default: /usr/share/backgrounds and
                 /usr/share/wallpapers, and where there are none, patterns of noise
  --path FILE    also writes a flight through the streets, as osgviewer -p reads it
  --seed N       another number gives another town; default 1
  --out FILE     the same as FILE
  --help         this text
)";

constexpr unsigned int MostTextures = 50000, MostSources = 24;
constexpr double BytesPerTexture = 550.0 * 1024.0;

struct Command
{
    TownSettings town;
    PictureSettings pictures;
    std::vector<std::string> photos;
    std::string file, path;
    bool texturesGiven = false, help = false;
};

int fail(const std::string& message)
{
    std::fprintf(stderr, "osgphotocity: %s\n", message.c_str());
    return 1;
}

bool readNumber(const std::string& text, std::uint32_t least, std::uint32_t most,
                std::uint32_t& value)
{
    std::uint32_t number = 0;
    const char* const end = text.data() + text.size();
    const auto [stop, failure] = std::from_chars(text.data(), end, number);
    if (failure != std::errc() || stop != end || number < least || number > most)
        return false;
    value = number;
    return true;
}

bool readBytes(const std::string& text, double& bytes)
{
    double value = 0.0;
    const char* const end = text.data() + text.size();
    const auto [stop, failure] = std::from_chars(text.data(), end, value);
    if (failure != std::errc() || !(value > 0.0))
        return false;
    const std::string unit(stop, end);
    const char* const units[] = {"", "KiB", "MiB", "GiB", "TiB"};
    for (int i = 0; i < 5; ++i)
        if (unit == units[i])
        {
            bytes = std::ldexp(value, 10 * i);
            return std::isfinite(bytes);
        }
    return false;
}

/// One option with its value. Returns what is wrong, or an empty text.
std::string set(Command& command, const std::string& option, const std::string& value)
{
    const auto number = [&](std::uint32_t least, std::uint32_t most,
                            std::uint32_t& result) -> std::string
    {
        if (readNumber(value, least, most, result))
            return {};
        return option + " needs a whole number from " + std::to_string(least) + " to " +
               std::to_string(most) + ", not '" + value + "'";
    };
    if (option == "--textures")
    {
        command.texturesGiven = true;
        return number(1, MostTextures, command.town.textures);
    }
    if (option == "--seed")
        return number(0, std::numeric_limits<std::uint32_t>::max(), command.town.seed);
    if (option == "--quality")
    {
        std::uint32_t quality = 0;
        const std::string fault = number(1, 100, quality);
        command.pictures.quality = int(quality);
        return fault;
    }
    if (option == "--bytes")
        return readBytes(value, command.pictures.bytes)
                   ? ""
                   : "--bytes needs a size such as 1.5GiB, 200MiB, 64KiB or 1000000, not '" +
                         value + "'";
    if (option == "--photos" && !value.empty())
        command.photos.push_back(value);
    else if (option == "--path" && !value.empty())
        command.path = value;
    else if (option == "--out" && !value.empty() && command.file.empty())
        command.file = value;
    else
        return "'" + option + " " + value + "' is no option; see --help";
    return {};
}

std::string parse(int argc, char** argv, Command& command)
{
    for (int i = 1; i < argc; ++i)
    {
        const std::string argument = argv[i];
        std::string fault;
        if (argument == "--help" || argument == "-h")
            command.help = true;
        else if (argument.rfind("-", 0) == 0)
            fault = set(command, argument, ++i < argc ? argv[i] : "");
        else if (command.file.empty())
            command.file = argument;
        else
            fault = "'" + argument + "' is a second file; see --help";
        if (!fault.empty() || command.help)
            return fault;
    }
    if (!command.texturesGiven && command.pictures.bytes > 0.0)
        command.town.textures = unsigned(
            std::min(std::ceil(command.pictures.bytes / BytesPerTexture), double(MostTextures)));
    return command.file.empty() ? "no file to write is named; see --help" : "";
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
    const std::string fault = parse(argc, argv, command);
    if (!fault.empty())
        return fail(fault);
    if (command.help)
        return std::fputs(Help, stdout) < 0;
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
