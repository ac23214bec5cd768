// SPDX-License-Identifier: MIT
#include <osgMultiRender/ImportFile.h>

#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>

namespace osgMultiRender
{

namespace
{

constexpr std::uintmax_t MaximumBytes = 16u << 20;

} // namespace

bool readTextFile(const std::string& fileName, std::string& text, std::string& error)
{
    std::error_code code;
    const std::filesystem::path path(fileName);
    if (!std::filesystem::is_regular_file(path, code))
    {
        error = "the file is not there";
        return false;
    }
    const std::uintmax_t size = std::filesystem::file_size(path, code);
    if (code || size > MaximumBytes)
    {
        error = code ? "the file can't be read" : "the file is larger than 16 MiB";
        return false;
    }
    std::ifstream file(path, std::ios::binary);
    text.resize(static_cast<std::size_t>(size));
    if (!file.read(text.data(), static_cast<std::streamsize>(size)))
    {
        error = "the file can't be read";
        return false;
    }
    if (text.compare(0, 3, "\xEF\xBB\xBF") == 0)
    {
        text.erase(0, 3);
    }
    return true;
}

void say(Rendering& rendering, bool error, const std::string& text)
{
    const std::string& file = rendering.fileName.empty() ? rendering.name : rendering.fileName;
    rendering.messages.push_back({error, file + ": " + text});
}

std::string baseName(const std::string& fileName)
{
    return std::filesystem::path(fileName).stem().string();
}

std::string pathBeside(Rendering& rendering, const std::string& name)
{
    namespace fs = std::filesystem;
    std::string plain = name;
    for (char& c : plain)
    {
        c = c == '\\' ? '/' : c;
    }
    const bool drive = plain.size() > 1 && plain[1] == ':';
    const fs::path path = fs::path(plain).lexically_normal();
    // "../textures/wood.png" is where real projects keep their pictures.
    const auto second = path.empty() ? path.end() : std::next(path.begin());
    const bool outside = path.empty() || path.is_absolute() || drive ||
                         plain.find('\0') != std::string::npos ||
                         (second != path.end() && *path.begin() == ".." && *second == "..");
    if (outside)
    {
        say(rendering, true, "it names '" + name + "', outside of its folder");
        return "";
    }
    return (fs::path(rendering.fileName).parent_path() / path).lexically_normal().string();
}

std::vector<double> readNumbers(const std::string& text, std::size_t& at)
{
    std::vector<double> numbers;
    for (;;)
    {
        const std::size_t start = std::min(text.find_first_not_of(" \t,;()+", at), text.size());
        double value = 0.0;
        const auto read = std::from_chars(text.data() + start, text.data() + text.size(), value);
        if (read.ec != std::errc() || !std::isfinite(value) || numbers.size() >= 4096)
        {
            return numbers;
        }
        numbers.push_back(value);
        at = static_cast<std::size_t>(read.ptr - text.data());
        at += at < text.size() && text[at] == 'f' ? 1 : 0;
    }
}

RenderingUniform& uniformOf(Rendering& rendering, const std::string& name)
{
    for (RenderingUniform& uniform : rendering.uniforms)
    {
        if (uniform.name == name)
        {
            return uniform;
        }
    }
    rendering.uniforms.emplace_back();
    rendering.uniforms.back().name = name;
    return rendering.uniforms.back();
}

} // namespace osgMultiRender
