// SPDX-License-Identifier: MIT
#include <osgMultiRender/Import.h>

#include <osgMultiRender/ImportFile.h>

#include <pugixml.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace osgMultiRender
{

namespace
{

// Beyond what any context has; ShaderDesigner itself knows 8 lights and 8 units.
constexpr unsigned int MaximumElements = 256;

/// Elements "Stem0", "Stem1", … of a parent: those that are there, whatever a count says.
std::vector<std::pair<unsigned int, pugi::xml_node>> numbered(pugi::xml_node parent,
                                                              const std::string& stem)
{
    std::vector<std::pair<unsigned int, pugi::xml_node>> result;
    for (pugi::xml_node child : parent.children())
    {
        const std::string name = child.name();
        if (name.compare(0, stem.size(), stem) != 0 || name.size() == stem.size() ||
            name.size() > stem.size() + 3 ||
            name.find_first_not_of("0123456789", stem.size()) != std::string::npos)
        {
            continue;
        }
        const auto number = static_cast<unsigned int>(std::stoul(name.substr(stem.size())));
        if (number < MaximumElements)
        {
            result.emplace_back(number, child);
        }
    }
    std::stable_sort(result.begin(), result.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    result.erase(std::unique(result.begin(), result.end(),
                             [](const auto& a, const auto& b) { return a.first == b.first; }),
                 result.end());
    return result;
}

/// A finite number, else `missing`. The decimal point is a point, whatever the locale.
double number(pugi::xml_node node, const std::string& attribute, double missing)
{
    const std::string text = node.attribute(attribute.c_str()).as_string();
    std::size_t at = 0;
    const std::vector<double> values = readNumbers(text, at);
    return values.empty() ? missing : values[0];
}

float real(pugi::xml_node node, const std::string& attribute, float missing)
{
    const double value = number(node, attribute, missing);
    return std::abs(value) < 1e30 ? static_cast<float>(value) : missing;
}

unsigned int enumeration(pugi::xml_node node, const char* attribute, unsigned int missing)
{
    const double value = number(node, attribute, missing);
    return value >= 0.0 && value < 65536.0 ? static_cast<unsigned int>(value) : missing;
}

bool flag(pugi::xml_node node, const char* attribute, bool missing)
{
    const std::string text = node.attribute(attribute).as_string();
    return text.empty() ? missing : text == "True" || text == "true" || text == "1";
}

/// "AmbR", "AmbG", … of an element.
RenderingColor color(pugi::xml_node node, const std::string& stem, RenderingColor missing,
                     const char* letters = "RGBA")
{
    for (std::size_t i = 0; i < 4; ++i)
    {
        missing[i] = real(node, stem + letters[i], missing[i]);
    }
    return missing;
}

class Project
{
public:
    Project(const std::string& text, const std::string& fileName) : _text(text)
    {
        _rendering.name = baseName(fileName);
        _rendering.fileName = fileName;
    }

    Rendering run()
    {
        // Entities other than XML's own are never expanded, nesting is not recursive.
        const pugi::xml_parse_result parsed = _document.load_buffer(
            _text.data(), _text.size(), pugi::parse_default, pugi::encoding_auto);
        const pugi::xml_node root = _document.child("GLSLang");
        if (!parsed || !root)
        {
            fail(parsed ? "it is no project of ShaderDesigner: the root is not 'GLSLang'"
                        : "it is no XML: " + std::string(parsed.description()) + " at byte " +
                              std::to_string(parsed.offset));
            return std::move(_rendering);
        }
        shaders(root.child("VPCount"), "VertexProgram", GlslStage::Vertex);
        shaders(root.child("FPCount"), "FragmentProgram", GlslStage::Fragment);
        if (root.child("GPCount").child("Filenames").first_child())
        {
            fail("it has a geometry program, which can't be merged");
        }
        if (_rendering.shaders.empty() && _rendering.messages.empty())
        {
            fail("it names no shaders");
        }
        textures(root.child("TexturedUsed"));
        uniforms(root.child("UniformVariables"));
        state(root);
        return std::move(_rendering);
    }

private:
    void fail(const std::string& text)
    {
        // One clear error; what follows from it is not news.
        if (_rendering.ok() || _rendering.messages.empty())
        {
            say(_rendering, true, text);
        }
    }

    void count(pugi::xml_node node, const char* attribute, std::size_t children)
    {
        const double declared = number(node, attribute, -1.0);
        if (node && declared != static_cast<double>(children))
        {
            say(_rendering, false,
                std::string(node.name()) + " counts " + node.attribute(attribute).as_string() +
                    ", but " + std::to_string(children) + " are there");
        }
    }

    void shaders(pugi::xml_node node, const char* attribute, GlslStage stage)
    {
        const auto files = numbered(node.child("Filenames"), "Filename");
        count(node, "numero", files.size());
        for (const auto& [index, file] : files)
        {
            const std::string name = file.attribute(attribute).as_string();
            const std::string path = name.empty() ? "" : pathBeside(_rendering, name);
            std::string error = "the file's name is missing";
            RenderingShader shader;
            shader.stage = stage;
            shader.fileName = path;
            if (!path.empty() && readTextFile(path, shader.text, error))
            {
                _rendering.shaders.push_back(std::move(shader));
            }
            else if (!path.empty() || name.empty())
            {
                fail(std::string(attribute) + " '" + name + "': " + error);
            }
        }
    }

    void textures(pugi::xml_node node)
    {
        const auto units = numbered(node, "TextureUnit");
        count(node, "NumberUsedTU", units.size());
        for (const auto& [unit, element] : units)
        {
            RenderingTexture texture;
            texture.unit = unit;
            const std::string file = element.attribute("Filename").as_string();
            texture.fileName = file.empty() ? "" : pathBeside(_rendering, file);
            texture.minFilter = enumeration(element, "MinFilter", texture.minFilter);
            texture.magFilter = enumeration(element, "MagFilter", texture.magFilter);
            texture.target = enumeration(element, "Target", texture.target);
            const char* const wraps[] = {"WrapS", "WrapT", "WrapR"};
            for (std::size_t i = 0; i < 3; ++i)
            {
                texture.wrap[i] = enumeration(element, wraps[i], texture.wrap[i]);
            }
            for (const char* face :
                 {"FilenameX", "Filename_X", "FilenameY", "Filename_Y", "FilenameZ", "Filename_Z"})
            {
                const std::string name = element.attribute(face).as_string();
                if (!name.empty())
                {
                    texture.faces.push_back(pathBeside(_rendering, name));
                }
            }
            checkFile(texture);
            _rendering.textures.push_back(std::move(texture));
        }
    }

    void checkFile(const RenderingTexture& texture)
    {
        std::error_code code;
        std::vector<std::string> files = texture.faces;
        files.push_back(texture.fileName);
        for (const std::string& file : files)
        {
            if (!file.empty() && !std::filesystem::is_regular_file(file, code))
            {
                say(_rendering, false, "texture '" + file + "' is not there");
            }
        }
    }

    void uniforms(pugi::xml_node node)
    {
        const auto all = numbered(node, "Uniform");
        count(node, "NumberOfVariables", all.size());
        for (const auto& [index, element] : all)
        {
            uniform(element);
        }
    }

    void uniform(pugi::xml_node element)
    {
        static const char* const types[] = {"",     "int",  "ivec2", "ivec3", "ivec4", "float",
                                            "vec2", "vec3", "vec4",  "mat2",  "mat3",  "mat4"};
        RenderingUniform one;
        one.name = element.attribute("Name").as_string();
        if (one.name.empty())
        {
            return;
        }
        const unsigned int type = enumeration(element, "Type", 0);
        one.type = type < std::size(types) ? types[type] : "";
        one.type = type == 1 ? "" : one.type; // an int or a sampler
        const double size = number(element, "ArraySize", 1.0);
        if (!(size >= 1.0 && size <= 4096.0))
        {
            say(_rendering, false,
                "uniform '" + one.name + "' has an array size of " +
                    element.attribute("ArraySize").as_string());
        }
        one.arraySize = size >= 1.0 && size <= 4096.0 ? static_cast<int>(size) : 1;
        one.minimum = number(element, "Min", 0.0);
        one.maximum = number(element, "Max", 1.0);
        for (const auto& [index, value] : values(element.child("Values")))
        {
            one.values.resize(std::max<std::size_t>(one.values.size(), index + 1), 0.0);
            one.values[index] = value;
        }
        _rendering.uniforms.push_back(std::move(one));
    }

    static std::vector<std::pair<unsigned int, double>> values(pugi::xml_node node)
    {
        std::vector<std::pair<unsigned int, double>> result;
        for (unsigned int i = 0; i < 4096; ++i)
        {
            const std::string name = "Value" + std::to_string(i);
            if (!node.attribute(name.c_str()))
            {
                break;
            }
            result.emplace_back(i, number(node, name, 0.0));
        }
        return result;
    }

    void state(pugi::xml_node root)
    {
        RenderingState& s = _rendering.state;
        const pugi::xml_node vertex = root.child("VertexProcessor");
        const pugi::xml_node fragment = root.child("FragmentProcessor");
        const pugi::xml_node states = root.child("BuiltInStates");
        s.given = vertex || fragment || states;
        s.cullFace = flag(vertex, "CullFace", s.cullFace);
        s.twoSided = flag(vertex, "TwoSidedValue", s.twoSided);
        s.polygonModeFront = enumeration(vertex, "PolygonModeFront", s.polygonModeFront);
        s.polygonModeBack = enumeration(vertex, "PolygonModeBack", s.polygonModeBack);
        s.shadeModel = enumeration(fragment, "Shade", s.shadeModel);
        s.alphaTest = flag(fragment, "AlphaTest", s.alphaTest);
        s.alphaFunction = enumeration(fragment, "AlphaFunc", s.alphaFunction);
        s.alphaReference = real(fragment, "AlphaClamp", s.alphaReference);
        s.blending = flag(fragment, "Blending", s.blending);
        s.blendSource = enumeration(fragment, "BlendFuncSRC", s.blendSource);
        s.blendDestination = enumeration(fragment, "BlendFuncDST", s.blendDestination);
        s.blendEquation = enumeration(fragment, "BlendEquation", s.blendEquation);
        s.depthTest = flag(fragment, "DepthTest", s.depthTest);
        s.depthFunction = enumeration(fragment, "DepthFunc", s.depthFunction);
        s.clearColor = color(fragment, "ClearColor", s.clearColor);
        s.hasMaterials = states.child("FrontMaterial") || states.child("BackMaterial");
        s.modelAmbient = color(states.child("ModelAmbient"), "Ambient", s.modelAmbient);
        s.front = material(states.child("FrontMaterial"));
        s.back = material(states.child("BackMaterial"));
        for (const auto& [index, element] : numbered(states, "Light"))
        {
            s.lights.push_back(light(index, element));
        }
    }

    static RenderingMaterial material(pugi::xml_node node)
    {
        RenderingMaterial m;
        m.ambient = color(node, "Amb", m.ambient);
        m.diffuse = color(node, "Dif", m.diffuse);
        m.specular = color(node, "Spec", m.specular);
        m.emission = color(node, "Emi", m.emission);
        m.shininess = std::min(std::max(real(node, "Shininess", 0.0f), 0.0f), 128.0f);
        return m;
    }

    static RenderingLight light(unsigned int index, pugi::xml_node node)
    {
        RenderingLight l;
        l.number = index;
        l.enabled = flag(node, "Enabled", false);
        l.position = color(node, "Pos", l.position, "XYZW");
        l.ambient = color(node, "Amb", l.ambient);
        l.diffuse = color(node, "Dif", l.diffuse);
        l.specular = color(node, "Spec", l.specular);
        const char* const axes[] = {"SpotDirX", "SpotDirY", "SpotDirZ"};
        const char* const attenuation[] = {"SpotConstant", "SpotLinear", "SpotQuadratic"};
        for (std::size_t i = 0; i < 3; ++i)
        {
            l.spotDirection[i] = real(node, axes[i], l.spotDirection[i]);
            l.attenuation[i] = real(node, attenuation[i], l.attenuation[i]);
        }
        l.spotExponent = real(node, "SpotExp", l.spotExponent);
        l.spotCutoff = real(node, "SpotCutoff", l.spotCutoff);
        return l;
    }

    const std::string& _text;
    pugi::xml_document _document;
    Rendering _rendering;
};

} // namespace

Rendering importShaderDesigner(const std::string& text, const std::string& fileName)
{
    return Project(text, fileName).run();
}

} // namespace osgMultiRender
