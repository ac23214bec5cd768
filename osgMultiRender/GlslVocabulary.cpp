// SPDX-License-Identifier: MIT
#include <osgMultiRender/GlslVocabulary.h>

#include <string>
#include <unordered_map>
#include <unordered_set>

namespace osgMultiRender
{

namespace
{

struct Era
{
    int version;
    const char* words; ///< Separated by blanks.
};

// Keywords and words reserved for the future, by the GLSL specification that has them first.
constexpr Era ReservedWords[] = {
    {110, "attribute const uniform varying break continue do for while if else in out inout float "
          "int void bool true false discard return mat2 mat3 mat4 vec2 vec3 vec4 ivec2 ivec3 "
          "ivec4 bvec2 bvec3 bvec4 sampler1D sampler2D sampler3D samplerCube sampler1DShadow "
          "sampler2DShadow struct asm class union enum typedef template this packed goto switch "
          "default inline noinline volatile public static extern external interface long short "
          "double half fixed unsigned input output hvec2 hvec3 hvec4 dvec2 dvec3 dvec4 fvec2 "
          "fvec3 fvec4 sampler2DRect sampler3DRect sampler2DRectShadow sizeof cast namespace "
          "using"},
    {120, "centroid invariant mat2x2 mat2x3 mat2x4 mat3x2 mat3x3 mat3x4 mat4x2 mat4x3 mat4x4 lowp "
          "mediump highp precision"},
    {130, "flat smooth noperspective case uint uvec2 uvec3 uvec4 samplerCubeShadow sampler1DArray "
          "sampler2DArray sampler1DArrayShadow sampler2DArrayShadow isampler1D isampler2D "
          "isampler3D isamplerCube isampler1DArray isampler2DArray usampler1D usampler2D "
          "usampler3D usamplerCube usampler1DArray usampler2DArray common partition active superp "
          "filter image1D image2D image3D imageCube iimage1D iimage2D iimage3D iimageCube "
          "uimage1D uimage2D uimage3D uimageCube image1DArray image2DArray iimage1DArray "
          "iimage2DArray uimage1DArray uimage2DArray image1DShadow image2DShadow "
          "image1DArrayShadow image2DArrayShadow imageBuffer iimageBuffer uimageBuffer row_major"},
    {140, "layout samplerBuffer isamplerBuffer usamplerBuffer isampler2DRect usampler2DRect"},
    {150, "sampler2DMS isampler2DMS usampler2DMS sampler2DMSArray isampler2DMSArray "
          "usampler2DMSArray"},
    {400, "patch sample subroutine precise samplerCubeArray samplerCubeArrayShadow "
          "isamplerCubeArray usamplerCubeArray dmat2 dmat3 dmat4 dmat2x2 dmat2x3 dmat2x4 dmat3x2 "
          "dmat3x3 dmat3x4 dmat4x2 dmat4x3 dmat4x4"},
    {420, "atomic_uint coherent restrict readonly writeonly resource image2DRect iimage2DRect "
          "uimage2DRect imageCubeArray iimageCubeArray uimageCubeArray image2DMS iimage2DMS "
          "uimage2DMS image2DMSArray iimage2DMSArray uimage2DMSArray"},
    {430, "buffer shared"},
};

constexpr Era BuiltinFunctions[] = {
    {110, "radians degrees sin cos tan asin acos atan pow exp log exp2 log2 sqrt inversesqrt abs "
          "sign floor ceil fract mod min max clamp mix step smoothstep length distance dot cross "
          "normalize ftransform faceforward reflect refract matrixCompMult lessThan lessThanEqual "
          "greaterThan greaterThanEqual equal notEqual any all not texture1D texture1DProj "
          "texture1DLod texture1DProjLod texture2D texture2DProj texture2DLod texture2DProjLod "
          "texture3D texture3DProj texture3DLod texture3DProjLod textureCube textureCubeLod "
          "shadow1D shadow2D shadow1DProj shadow2DProj shadow1DLod shadow2DLod shadow1DProjLod "
          "shadow2DProjLod dFdx dFdy fwidth noise1 noise2 noise3 noise4 texture2DRect "
          "texture2DRectProj shadow2DRect shadow2DRectProj matrixCompMult"},
    {120, "outerProduct transpose"},
    {130, "sinh cosh tanh asinh acosh atanh trunc round roundEven modf isnan isinf texture "
          "textureSize textureProj textureLod textureOffset texelFetch texelFetchOffset "
          "textureProjOffset textureLodOffset textureProjLod textureProjLodOffset textureGrad "
          "textureGradOffset textureProjGrad textureProjGradOffset"},
    {140, "inverse"},
    {150, "determinant EmitVertex EndPrimitive"},
    {330, "floatBitsToInt floatBitsToUint intBitsToFloat uintBitsToFloat"},
    {400, "fma frexp ldexp packUnorm2x16 packUnorm4x8 packSnorm4x8 unpackUnorm2x16 unpackUnorm4x8 "
          "unpackSnorm4x8 packDouble2x32 unpackDouble2x32 bitfieldExtract bitfieldInsert "
          "bitfieldReverse bitCount findLSB findMSB uaddCarry usubBorrow umulExtended "
          "imulExtended textureGather textureGatherOffset textureGatherOffsets textureQueryLod "
          "interpolateAtCentroid interpolateAtSample interpolateAtOffset EmitStreamVertex "
          "EndStreamPrimitive barrier"},
    {420, "packSnorm2x16 unpackSnorm2x16 packHalf2x16 unpackHalf2x16 atomicCounter "
          "atomicCounterIncrement atomicCounterDecrement imageLoad imageStore imageAtomicAdd "
          "imageAtomicMin imageAtomicMax imageAtomicAnd imageAtomicOr imageAtomicXor "
          "imageAtomicExchange imageAtomicCompSwap memoryBarrier"},
    {430, "textureQueryLevels imageSize atomicAdd atomicMin atomicMax atomicAnd atomicOr atomicXor "
          "atomicExchange atomicCompSwap memoryBarrierAtomicCounter memoryBarrierBuffer "
          "memoryBarrierImage memoryBarrierShared groupMemoryBarrier"},
    {450, "dFdxFine dFdyFine dFdxCoarse dFdyCoarse fwidthFine fwidthCoarse textureSamples "
          "imageSamples"},
    {460, "anyInvocation allInvocations allInvocationsEqual"},
};

using Table = std::unordered_map<std::string_view, int>;

template <typename Add> void forEachWord(std::string_view words, Add add)
{
    while (!words.empty())
    {
        const std::size_t end = words.find(' ');
        add(words.substr(0, end));
        words.remove_prefix(end == std::string_view::npos ? words.size() : end + 1);
    }
}

template <std::size_t N> Table makeTable(const Era (&eras)[N])
{
    Table table;
    for (const Era& era : eras)
    {
        forEachWord(era.words, [&](std::string_view word) { table.emplace(word, era.version); });
    }
    return table;
}

int find(const Table& table, std::string_view word)
{
    const auto found = table.find(word);
    return found == table.end() ? 0 : found->second;
}

std::unordered_set<std::string_view> makeSet(std::string_view words)
{
    std::unordered_set<std::string_view> set;
    forEachWord(words, [&](std::string_view word) { set.insert(word); });
    return set;
}

bool startsWith(std::string_view word, std::string_view prefix)
{
    return word.substr(0, prefix.size()) == prefix;
}

} // namespace

int reservedSince(std::string_view word)
{
    static const Table table = makeTable(ReservedWords);
    return find(table, word);
}

int builtinFunctionSince(std::string_view word)
{
    static const Table table = makeTable(BuiltinFunctions);
    return find(table, word);
}

bool isQualifier(std::string_view word)
{
    static const auto set =
        makeSet("attribute const uniform varying in out inout centroid invariant lowp mediump "
                "highp flat smooth noperspective patch sample precise subroutine coherent volatile "
                "restrict readonly writeonly buffer shared");
    return set.count(word) != 0;
}

bool isBuiltinType(std::string_view word)
{
    static const auto scalars = makeSet("void float int bool uint double atomic_uint");
    if (scalars.count(word))
    {
        return true;
    }
    if (!reservedSince(word))
    {
        return false;
    }
    static constexpr std::string_view prefixes[] = {
        "vec",   "ivec",   "bvec",   "uvec",    "dvec",     "mat",     "dmat",
        "image", "iimage", "uimage", "sampler", "isampler", "usampler"};
    for (std::string_view prefix : prefixes)
    {
        if (startsWith(word, prefix))
        {
            return true;
        }
    }
    return false;
}

} // namespace osgMultiRender
