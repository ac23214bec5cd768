// SPDX-License-Identifier: MIT
#include <osgMultiRender/MixProgram.h>

#include <osgMultiRender/MixState.h>
#include <osgMultiRender/MixTexture.h>

#include <osg/Program>
#include <osg/Shader>

#include <algorithm>

namespace osgMultiRender
{

namespace
{

osg::Program* makeProgram(const Merged& merged, const MixSet& set)
{
    auto* program = new osg::Program;
    std::string name = set.isWhole ? "only" : "mix of";
    for (const MergedRendering& rendering : merged.renderings)
        if (rendering.included)
            name += " " + rendering.name;
    // Drivers take 256 bytes as a label; OSG hands the name on.
    if (name.size() > 120)
        name = name.substr(0, 120) + "...";
    program->setName(name);
    for (const auto type : {osg::Shader::VERTEX, osg::Shader::FRAGMENT})
    {
        const bool isVertex = type == osg::Shader::VERTEX;
        auto* shader = new osg::Shader(type, isVertex ? merged.vertex : merged.fragment);
        shader->setName(name + (isVertex ? ".vert" : ".frag"));
        program->addShader(shader);
    }
    for (const MergedUniform& uniform : merged.uniforms)
        if (uniform.type == "block" && uniform.binding >= 0)
            program->addBindUniformBlock(uniform.merged, GLuint(uniform.binding));
    return program;
}

/// Puts values into all elements; what is missing stays.
void setValues(osg::Uniform& uniform, const std::vector<double>& values)
{
    const auto copy = [&](auto* array)
    {
        if (!array)
            return false;
        using Number = typename std::decay_t<decltype(*array)>::ElementDataType;
        const std::size_t size = std::min<std::size_t>(values.size(), array->size());
        for (std::size_t i = 0; i < size; ++i)
            (*array)[i] = static_cast<Number>(values[i]);
        return true;
    };
    if (copy(uniform.getFloatArray()) || copy(uniform.getIntArray()) ||
        copy(uniform.getUIntArray()) || copy(uniform.getDoubleArray()))
        uniform.dirty();
}

const char* const surfacePosition =
    "void osgmr_mixBegin()\n{\n"
    "    vec3 place = vec3((gl_FragCoord.xy - osgmr_mixViewport.xy) * osgmr_mixViewport.zw,\n"
    "                      2.0 * (gl_FragCoord.z - gl_DepthRange.near) / gl_DepthRange.diff);\n"
    "    vec4 clip = vec4(place - 1.0, 1.0) / gl_FragCoord.w;\n"
    "    osgmr_mixAt((gl_ProjectionMatrixInverse * clip).xyz);\n"
    "}\n";

/// Where nothing was drawn, or beyond what a float's square holds, there is no distance.
const char* const framePosition =
    "uniform sampler2D osgmr_mixDepth;\n"
    "void osgmr_mixBegin()\n{\n"
    "    vec2 at = gl_FragCoord.xy - osgmr_mixViewport.xy;\n"
    "    float depth = texelFetch(osgmr_mixDepth, ivec2(at), 0).r;\n"
    "    vec3 place = vec3(at * osgmr_mixViewport.zw,\n"
    "                      2.0 * (depth - gl_DepthRange.near) / gl_DepthRange.diff);\n"
    "    vec4 eye = gl_ProjectionMatrixInverse * vec4(place - 1.0, 1.0);\n"
    "    osgmr_mixAt(depth < 1.0 ? eye.xyz / eye.w : vec3(1e30));\n"
    "}\n";

/// GLSL behind mix.glsl: an entry's slot, the position of the fragment, what is left to show.
std::string weightsOf(const MixSet& set, bool isOfFrame)
{
    if (set.isWhole)
        return "float osgmr_weight(int rendering)\n{\n    return 1.0;\n}\n";
    std::string slots;
    for (const MixSet::Member& member : set.members)
        slots += (slots.empty() ? "" : ", ") + std::to_string(member.slot);
    const std::string count = "[" + std::to_string(set.members.size()) + "]";
    return "#define osgmr_weight osgmr_slotWeight\n" + MixState::getSource() +
           "#undef osgmr_weight\n"
           "uniform vec4 osgmr_mixViewport; // place; 2 / size\n"
           "const int osgmr_slots" +
           count + " = int" + count + "(" + slots + ");\n" +
           (isOfFrame ? framePosition : surfacePosition) +
           "float osgmr_weight(int rendering)\n{\n"
           "    return osgmr_slotWeight(osgmr_slots[rendering]);\n"
           "}\n"
           "vec4 osgmr_mixEnd(vec4 sum)\n{\n"
           "    vec4 color = osgmr_mixed(sum);\n" +
           // A discard anywhere in the text puts the depth test behind the fragment's computation.
           (set.isTransparent ? "    if (color.a == 0.0)\n        discard;\n" : "") +
           "    return color;\n"
           "}\n";
}

/// Null where the program reads the model's texture.
const RenderingTexture* ownTexture(const MergedTexture& texture, const MixSet::Member& member,
                                   const MixSnapshot& snapshot)
{
    return texture.own ? snapshot.slots[member.slot].rendering->findTexture(texture.ownUnit)
                       : nullptr;
}

} // namespace

bool MixSet::has(std::uint16_t slot) const
{
    return std::any_of(members.begin(), members.end(),
                       [&](const Member& member) { return member.slot == slot; });
}

Merged mergeSet(const MixSet& set, const MixSnapshot& snapshot, const MergeLimits& limits,
                const MixSlotShares& shares)
{
    std::vector<MergeEntry> entries;
    MergeOptions options;
    options.base = set.members.size(); // none
    for (const MixSet::Member& member : set.members)
    {
        if (snapshot.rules.base == member.slot)
            options.base = entries.size();
        const MixSlot* slot =
            member.slot < snapshot.slots.size() ? &snapshot.slots[member.slot] : nullptr;
        const bool isThere = slot && slot->id == member.id;
        const double share = member.slot < shares.size() ? shares[member.slot] : 1.0;
        entries.push_back({isThere ? slot->rendering.get() : nullptr, share});
    }
    options.limits = limits;
    options.ownLighting = set.ownLighting;
    options.lights = set.lights;
    options.weights = weightsOf(set, snapshot.isOfFrame);
    if (!set.isWhole)
    {
        options.begin = "osgmr_mixBegin();";
        if (!snapshot.isOfFrame) // there the vertices are those of a triangle over the picture
            options.beginAt = "osgmr_mixAt";
        options.end = "osgmr_mixEnd";
        options.outside = MergeOutside::Transparent;
    }
    // The model's own and those of the kits.
    for (unsigned int unit = 0; unit <= 16; ++unit)
        options.occupiedUnits.push_back(unit);
    return mergeRenderings(entries, options);
}

void readTextures(const MixSet& set, const Merged& merged, const MixSnapshot& snapshot,
                  MixTextures& textures)
{
    for (const MergedTexture& texture : merged.textures)
    {
        const MixSet::Member& member = set.members[texture.rendering];
        if (const RenderingTexture* own = ownTexture(texture, member, snapshot))
            textures.get(member.id, *own);
    }
}

MixProgram::MixProgram(const MixSet& set, Merged merged, const MixSnapshot& snapshot,
                       MixTextures& textures)
    : SurfaceLook(makeProgram(merged, set), new osg::StateSet), _set(set),
      _merged(std::move(merged))
{
    addUniforms(snapshot);
    addTextures(snapshot, textures);
}

bool MixProgram::covers(std::uint16_t slot) const
{
    for (std::size_t i = 0; i < _set.members.size(); ++i)
        if (_set.members[i].slot == slot)
            return _merged.renderings[i].included;
    return false;
}

void MixProgram::addUniforms(const MixSnapshot& snapshot)
{
    for (const MergedUniform& merged : _merged.uniforms)
    {
        const osg::Uniform::Type type = osg::Uniform::getTypeId(merged.type);
        if (type == osg::Uniform::UNDEFINED || merged.inBlock ||
            merged.merged.compare(0, 4, "osg_") == 0)
            continue; // blocks and structs are the application's, osg_ is OSG's
        const int size = std::max(1, merged.arraySize);
        const std::uint16_t slot = _set.members[merged.rendering].slot;
        if (merged.units.empty())
        {
            const RenderingUniform* own = snapshot.slots[slot].rendering->findUniform(merged.name);
            _values.push_back({type, merged.merged, size, slot, merged.name,
                               own ? own->values : std::vector<double>()});
            continue;
        }
        const osg::ref_ptr<osg::Uniform> uniform = new osg::Uniform(type, merged.merged, size);
        setValues(*uniform, std::vector<double>(merged.units.begin(), merged.units.end()));
        _stateSet->addUniform(uniform);
    }
}

void MixProgram::addTextures(const MixSnapshot& snapshot, MixTextures& textures)
{
    for (const MergedTexture& texture : _merged.textures)
    {
        const MixSet::Member& member = _set.members[texture.rendering];
        const RenderingTexture* own = ownTexture(texture, member, snapshot);
        // Below the model's own textures, above nothing: a model without one is white.
        _stateSet->setTextureAttribute(
            texture.unit, own ? textures.get(member.id, *own) : textures.getWhite(),
            own ? osg::StateAttribute::OVERRIDE : osg::StateAttribute::ON);
    }
}

void MixProgram::Values::send(const osg::Program::PerContextProgram& program,
                              osg::State& state) const
{
    for (const osg::ref_ptr<osg::Uniform>& uniform : uniforms)
        if (const GLint place = program.getUniformLocation(uniform->getNameID()); place >= 0)
            uniform->apply(state.get<osg::GLExtensions>(), place);
}

std::shared_ptr<const MixProgram::Values> MixProgram::valuesOf(const MixSnapshot& snapshot)
{
    std::lock_guard<std::mutex> lock(_mutex);
    if (_latest && _latest->revision == snapshot.uniformRevision)
        return _latest;
    const auto made = std::make_shared<Values>();
    made->revision = snapshot.uniformRevision;
    for (const Value& value : _values)
    {
        const std::vector<double>* values = &value.ownValues;
        if (value.slot < snapshot.slots.size())
        {
            const MixUniforms& given = snapshot.slots[value.slot].uniforms;
            if (const auto found = given.find(value.name); found != given.end())
                values = &found->second;
        }
        if (values->empty())
            continue; // as the text says
        made->uniforms.push_back(new osg::Uniform(value.type, value.merged, value.arraySize));
        setValues(*made->uniforms.back(), *values);
    }
    _latest = made;
    return made;
}

} // namespace osgMultiRender
