// SPDX-License-Identifier: MIT
// The text of our own main: bindOutputs() and wrapperMain().
#include <osgMultiRender/GlslWrap.h>

#include <algorithm>
#include <set>

namespace osgMultiRender
{

namespace
{

/// Elements of an output that are written, by number.
std::vector<int> elementsOf(const GlslOutput& output, int maximumDrawBuffers)
{
    if (!output.elements.empty())
    {
        return output.elements;
    }
    const bool all = output.arraySize == GlslOutput::AllDrawBuffers;
    const int count = all ? maximumDrawBuffers : std::max(output.arraySize, 1);
    std::vector<int> result;
    for (int i = 0; i < count; ++i)
    {
        result.push_back(i);
    }
    return result;
}

/// One `layout(location = n) out` of ours.
struct Target
{
    int location;
    std::string type;
    std::string value; ///< The user's variable, with its index.
};

std::vector<Target> targetsOf(const std::vector<GlslOutput>& outputs,
                              const GlslMainOptions& options)
{
    std::vector<Target> targets;
    for (const GlslOutput& output : outputs)
    {
        const int location = std::max(output.location, 0);
        if (output.broadcast)
        {
            for (int i = 0; i < std::max(options.drawBuffers, 1); ++i)
            {
                targets.push_back({location + i, output.type, output.variable});
            }
            continue;
        }
        for (int element : elementsOf(output, options.maximumDrawBuffers))
        {
            const std::string index =
                output.arraySize ? "[" + std::to_string(element) + "]" : std::string();
            targets.push_back({location + element, output.type, output.variable + index});
        }
    }
    targets.erase(std::remove_if(targets.begin(), targets.end(),
                                 [&options](const Target& target)
                                 { return target.location >= options.userLocations; }),
                  targets.end());
    std::sort(targets.begin(), targets.end(),
              [](const Target& a, const Target& b) { return a.location < b.location; });
    return targets;
}

std::string declarationOf(const GlslOutput& output)
{
    std::string array;
    if (output.variable == "osgmr_fragData")
    {
        array = "[gl_MaxDrawBuffers]";
    }
    else if (output.arraySize)
    {
        array = "[" + std::to_string(output.arraySize) + "]";
    }
    return output.type + " " + output.variable + array + ";\n";
}

/// An expression of type vec4 for a colour of `type`.
std::string asColor(const std::string& type, const std::string& value)
{
    if (type == "vec4")
    {
        return value;
    }
    if (type == "vec3")
    {
        return "vec4(" + value + ", 1.0)";
    }
    if (type == "vec2")
    {
        return "vec4(" + value + ", 0.0, 1.0)";
    }
    return type == "float" ? "vec4(" + value + ", 0.0, 0.0, 1.0)" : "vec4(0.0)";
}

std::string withLineEnd(const std::string& text)
{
    return text.empty() || text.back() == '\n' ? text : text + "\n";
}

} // namespace

bool bindOutputs(std::vector<GlslOutput>& outputs,
                 const std::map<std::string, unsigned int>& bindings, std::string& error)
{
    std::map<int, std::string> taken;
    const auto take = [&](const GlslOutput& output)
    {
        for (int element : elementsOf(output, 1))
        {
            const auto added = taken.emplace(output.location + element, output.name);
            if (!added.second)
            {
                error = "outputs '" + added.first->second + "' and '" + output.name +
                        "' are both at location " + std::to_string(output.location + element);
                return false;
            }
        }
        return true;
    };
    for (GlslOutput& output : outputs)
    {
        const auto bound = bindings.find(output.name);
        if (output.location < 0 && bound != bindings.end() && bound->second < 64)
        {
            output.location = static_cast<int>(bound->second);
        }
        if (output.location >= 0 && !take(output))
        {
            return false;
        }
    }
    for (GlslOutput& output : outputs)
    {
        const std::vector<int> elements = elementsOf(output, 1);
        const bool placed = output.location >= 0;
        for (int location = 0; !placed && output.location < 0; ++location)
        {
            const bool free =
                std::none_of(elements.begin(), elements.end(),
                             [&](int element) { return taken.count(location + element) != 0; });
            output.location = free ? location : -1;
        }
        if (!placed && !take(output))
        {
            return false;
        }
    }
    return true;
}

std::string wrapperMain(const GlslVersion& version, const std::vector<GlslOutput>& outputs,
                        const GlslMainOptions& options)
{
    const std::vector<Target> targets = targetsOf(outputs, options);
    const bool first = !targets.empty() && targets[0].location == 0;
    std::string text = "#version " + toString(version) + "\nvoid osgmr_userMain();\n";
    for (const GlslOutput& output : outputs)
    {
        text += declarationOf(output);
    }
    for (const Target& target : targets)
    {
        const std::string location = std::to_string(target.location);
        text += "layout(location = " + location + ") out " + target.type + " osgmr_out" + location +
                ";\n";
    }
    for (const GlslSnippet& snippet : options.snippets)
    {
        text += withLineEnd(snippet.declarations);
    }
    text += "vec4 osgmr_surface()\n{\n    osgmr_userMain();\n    return " +
            (first ? asColor(targets[0].type, targets[0].value) : "vec4(0.0)") + ";\n}\n";
    const bool direct = first && targets[0].type == "vec4";
    text += "void main()\n{\n    ";
    text += direct ? "osgmr_out0 = osgmr_surface();\n" : "osgmr_surface();\n";
    for (std::size_t i = direct ? 1 : 0; i < targets.size(); ++i)
    {
        text += "    osgmr_out" + std::to_string(targets[i].location) + " = " + targets[i].value +
                ";\n";
    }
    for (const GlslSnippet& snippet : options.snippets)
    {
        text += withLineEnd(snippet.statements);
    }
    return text + "}\n";
}

} // namespace osgMultiRender
