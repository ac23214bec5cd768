// SPDX-License-Identifier: MIT
// The complete text of a merged program.
#include <osgMultiRender/MergeProgram.h>

#include <algorithm>
#include <locale>
#include <sstream>

namespace osgMultiRender
{

namespace
{

std::string typeOf(const MergeVector& vector)
{
    if (vector.used == 1)
    {
        return vector.base == 'f' ? "float" : vector.base == 'i' ? "int" : "uint";
    }
    const std::string prefix = vector.base == 'f' ? "" : std::string(1, vector.base);
    return prefix + "vec" + std::to_string(vector.used);
}

/// The part of its vector that a varying is.
std::string partOf(const MergeVarying& one, const std::vector<MergeVector>& vectors)
{
    const MergeVector& vector = vectors[one.slot];
    if (one.components == vector.used)
    {
        return vector.name;
    }
    return vector.name + "." +
           std::string("xyzw").substr(std::size_t(one.offset), std::size_t(one.components));
}

/// Behaviours, the stronger the later.
int strengthOf(const std::string& behavior)
{
    const char* const order[] = {"disable", "warn", "enable", "require"};
    for (int i = 0; i < 4; ++i)
    {
        if (behavior == order[i])
        {
            return i;
        }
    }
    return -1;
}

class MergeWriter
{
public:
    MergeWriter(const std::vector<MergeProgram*>& programs, const std::vector<MergeVector>& vectors,
                const MergeOptions& options, Merged& merged)
        : _programs(programs), _vectors(vectors), _options(options), _merged(merged)
    {
        for (const MergeProgram* program : programs)
        {
            _base = program->id == options.base ? program : _base;
            _depth = _depth || !program->depth.empty();
            _discards = _discards || program->discards;
        }
        _base = _base ? _base : programs.front();
    }

    void run()
    {
        head();
        vertexHead();
        sections(false);
        vertexMain();
        _merged.vertex = std::move(_text);
        _text.clear();
        _lines = 0;
        _counted = 0;
        head();
        fragmentHead();
        sections(true);
        weights();
        fragmentMain();
        _merged.fragment = std::move(_text);
    }

private:
    void head()
    {
        _text += "#version " + toString(_merged.version) + "\n";
        std::map<std::string, int> extensions;
        bool invariant = false;
        for (const MergeProgram* program : _programs)
        {
            invariant = invariant || program->invariantAll;
            for (const GlslExtension& extension : program->extensions)
            {
                // Those of GLSL ES are part of the desktop's.
                const bool es = extension.name.compare(0, 7, "GL_OES_") == 0;
                const int strength = strengthOf(extension.behavior);
                if (strength >= 0 && extension.name != "all" && !es)
                {
                    const auto [found, added] = extensions.emplace(extension.name, strength);
                    found->second = std::max(found->second, strength);
                }
            }
        }
        const char* const behaviors[] = {"disable", "warn", "enable", "require"};
        for (const auto& [name, strength] : extensions)
        {
            _text += "#extension " + name + " : " + behaviors[strength] + "\n";
        }
        _text += invariant ? "#pragma STDGL invariant(all)\n" : "";
        ownLine();
    }

    /// Gives our own lines their numbers in this text.
    void ownLine()
    {
        const auto from = _text.begin() + static_cast<std::ptrdiff_t>(_counted);
        _lines += std::count(from, _text.end(), '\n');
        _counted = _text.size();
        _text += lineDirective(_merged.files.size(), static_cast<unsigned long>(_lines) + 2) + "\n";
    }

    void vectors(const char* direction)
    {
        for (const MergeVector& vector : _vectors)
        {
            const std::string& interpolation = vector.interpolation;
            _text += interpolation + (interpolation.empty() ? "" : " ") + direction + " " +
                     typeOf(vector) + " " + vector.name + ";\n";
        }
    }

    void vertexHead()
    {
        for (const MergedAttribute& attribute : _merged.attributes)
        {
            if (attribute.location >= 0)
            {
                _text += "layout(location = " + std::to_string(attribute.location) + ") ";
            }
            _text += "in " + attribute.type + " " + attribute.merged + ";\n";
        }
        vectors("out");
    }

    void fragmentHead()
    {
        vectors("in");
        _text += "layout(location = 0) out vec4 osgmr_color;\n";
    }

    void sections(bool fragment)
    {
        for (const MergeProgram* program : _programs)
        {
            _text += "\n// " + program->name + ", rendering " + std::to_string(program->id) + "\n";
            _text += builtinGlobals(*program, fragment);
            _text += mergedText(*program, fragment ? program->fragment : program->vertex,
                                _merged.version);
            ownLine();
        }
    }

    std::string mainOf(const MergeProgram& program) const
    {
        return program.vertex.entities.at("main").merged;
    }

    void vertexMain()
    {
        _text += "\nvoid main()\n{\n";
        for (const MergeProgram* program : _programs)
        {
            _text += "    " + mainOf(*program) + "();\n";
        }
        for (const auto& [builtin, name] : _base->vertex.builtins)
        {
            if (builtin == "gl_ClipDistance")
            {
                for (int i = 0; i < _base->vertex.clipDistances; ++i)
                {
                    const std::string index = "[" + std::to_string(i) + "]";
                    _text += "    gl_ClipDistance" + index + " = " + name + index + ";\n";
                }
            }
            else if (builtin == "gl_Position" || builtin == "gl_PointSize" ||
                     builtin == "gl_ClipVertex")
            {
                _text += "    " + builtin + " = " + name + ";\n";
            }
        }
        for (const MergeProgram* program : _programs)
        {
            for (const MergeVarying& one : program->varyings)
            {
                if (!one.sharedWith)
                {
                    _text += "    " + partOf(one, _vectors) + " = " + one.vertex + ";\n";
                }
            }
        }
        _text += "}\n";
    }

    void weights()
    {
        if (_options.weights.empty())
        {
            _text += "\nfloat osgmr_weight(int rendering)\n{\n    return 1.0 / " +
                     std::to_string(_programs.size()) + ".0;\n}\n";
            return;
        }
        _text += "\n" + lineDirective(_merged.files.size() + 1, 1) + "\n";
        _text += _options.weights;
        _text += _options.weights.back() == '\n' ? "" : "\n";
        ownLine();
    }

    void unpack(const MergeProgram& program, const std::string& indent)
    {
        for (const MergeVarying& one : program.varyings)
        {
            const std::string condition =
                one.condition.empty() ? "" : "if (" + one.condition + ") ";
            _text += indent + condition + one.fragment + " = " + partOf(one, _vectors) + ";\n";
        }
    }

    /// A varying that holds where the fragment is; empty if none is known to.
    std::string eyePosition() const
    {
        if (!hasUsualPosition(*_base))
        {
            return "";
        }
        for (const MergeProgram* program : _programs)
        {
            for (const MergeVarying& one : program->varyings)
            {
                if (isEyePosition(one))
                {
                    return partOf(one, _vectors) + (one.components == 4 ? ".xyz" : "");
                }
            }
        }
        return "";
    }

    void fragmentMain()
    {
        _text += "\nvoid main()\n{\n"
                 "    vec3 osgmr_sum = vec3(0.0);\n"
                 "    float osgmr_total = 0.0;\n"
                 "    float osgmr_w;\n"
                 "    vec4 osgmr_c;\n";
        // Without a discard in the text fragments are tested for depth before they are computed.
        _text += _discards ? "    bool osgmr_any = false;\n" : "";
        _text += _depth ? "    float osgmr_depth = 0.0;\n" : "";
        _text += _options.outside == MergeOutside::Base ? "    vec4 osgmr_base;\n" : "";
        const std::string eye = _options.beginAt.empty() ? "" : eyePosition();
        const std::string begin =
            eye.empty() ? _options.begin : _options.beginAt + "(" + eye + ");";
        _text += begin.empty() ? "" : "    " + begin + "\n";
        // What is computed in each fragment comes first: compilers use it again within branches.
        for (const bool branches : {false, true})
        {
            for (const MergeProgram* program : _programs)
            {
                if (isBranch(*program) == branches)
                {
                    rendering(*program);
                }
            }
        }
        result();
        _text += "}\n";
    }

    bool isBase(const MergeProgram& program) const
    {
        return _options.outside == MergeOutside::Base && &program == _base;
    }

    /// Whether it is computed only where it has weight.
    bool isBranch(const MergeProgram& program) const
    {
        return _options.skipZeroWeights && !program.derivatives && !isBase(program);
    }

    void rendering(const MergeProgram& program)
    {
        const std::string id = std::to_string(program.id);
        const bool branch = isBranch(program);
        const std::string call =
            "osgmr_c = " + program.fragment.entities.at("main").merged + "();\n";
        _text +=
            "\n    // " + program.name + (program.derivatives ? ", takes derivatives" : "") + "\n";
        if (!branch)
        {
            unpack(program, "    ");
            _text += "    " + call;
            _text += isBase(program) ? "    osgmr_base = osgmr_c;\n" : "";
        }
        _text += "    osgmr_w = osgmr_weight(" + id + ");\n    if (osgmr_w > 0.0)\n    {\n";
        if (branch)
        {
            unpack(program, "        ");
            _text += "        " + call;
        }
        _text += _discards ? "        osgmr_any = true;\n" : "";
        const std::string passes = alphaTestOf(program.rendering->state, "osgmr_c.a");
        if (!passes.empty())
        {
            _text += "        " + program.discarded + " = " + program.discarded + " || !(" +
                     passes + ");\n";
        }
        const std::string indent = program.discards ? "            " : "        ";
        _text += program.discards ? "        if (!" + program.discarded + ")\n        {\n" : "";
        _text += indent + "osgmr_sum += osgmr_w * osgmr_c.rgb;\n";
        _text += indent + "osgmr_total += osgmr_w;\n";
        if (_depth)
        {
            _text += indent + "osgmr_depth += osgmr_w * " +
                     (program.depth.empty() ? "gl_FragCoord.z" : program.depth) + ";\n";
        }
        _text += program.discards ? "        }\n" : "";
        _text += "    }\n";
    }

    void result()
    {
        _text += "\n    if (!(osgmr_total > 0.0))\n    {\n";
        if (_options.outside == MergeOutside::Background)
        {
            _text += "        discard;\n";
        }
        else
        {
            if (_discards)
            {
                _text += "        if (osgmr_any)\n        {\n            discard;\n        }\n";
            }
            if (_options.outside == MergeOutside::Base)
            {
                _text += _base->discards ? "        if (" + _base->discarded +
                                               ")\n        {\n            discard;\n        }\n"
                                         : "";
                _text += "        osgmr_sum = osgmr_base.rgb;\n        osgmr_total = 1.0;\n";
                _text += _depth ? "        osgmr_depth = " +
                                      (_base->depth.empty() ? std::string("gl_FragCoord.z")
                                                            : _base->depth) +
                                      ";\n"
                                : "";
            }
        }
        _text += "    }\n";
        if (_depth)
        {
            _text += "    gl_FragDepth = osgmr_total > 0.0 ? osgmr_depth / osgmr_total : "
                     "gl_FragCoord.z;\n";
        }
        if (_options.normalize)
        {
            _text +=
                "    if (osgmr_total > 1.0)\n    {\n        osgmr_sum /= osgmr_total;\n    }\n";
        }
        const std::string sum = "vec4(osgmr_sum, osgmr_total)";
        _text += "    osgmr_color = " +
                 (_options.end.empty() ? "clamp(" + sum + ", 0.0, 1.0)"
                                       : _options.end + "(" + sum + ")") +
                 ";\n";
    }

    const std::vector<MergeProgram*>& _programs;
    const std::vector<MergeVector>& _vectors;
    const MergeOptions& _options;
    Merged& _merged;
    const MergeProgram* _base = nullptr;
    bool _depth = false;
    bool _discards = false; ///< Any of the programs.
    std::string _text;
    std::ptrdiff_t _lines = 0; ///< In the first `_counted` bytes of the text.
    std::size_t _counted = 0;
};

} // namespace

std::string alphaTestOf(const RenderingState& state, const std::string& alpha)
{
    constexpr unsigned int never = 0x0200; // the functions follow as OpenGL numbers them
    static const char* const compare[] = {"", " < ", " == ", " <= ", " > ", " != ", " >= ", ""};
    const unsigned int function = state.alphaFunction - never;
    if (!state.alphaTest || function >= 7) // GL_ALWAYS, or none
    {
        return "";
    }
    std::ostringstream text;
    text.imbue(std::locale::classic());
    text << std::showpoint << "clamp(" << alpha << ", 0.0, 1.0)" << compare[function]
         << state.alphaReference;
    return function == 0 ? "false" : text.str();
}

void writeMerged(const std::vector<MergeProgram*>& programs,
                 const std::vector<MergeVector>& vectors, const MergeOptions& options,
                 Merged& merged)
{
    MergeWriter(programs, vectors, options, merged).run();
}

} // namespace osgMultiRender
