// All lights that may reach this fragment, by the fixed function's equation.
//
// A light is six vec4:
//   0 position or unit direction towards the light; type (0 directional, 1 point,
//     2 spot, 3 directional with a cone)
//   1 ambient, constant attenuation      2 diffuse, linear attenuation
//   3 specular, quadratic attenuation    4 unit spot direction, cosine of the cutoff
//   5 spot exponent; index among the lights that cast visible shadows, or -1; lux at one unit
// Few lights are uniforms, unrolled by generated code with their types (OSGSV_UNIFORM holds their
// number). Many lie in osgsv_lights, six texels a light, 256 lights a row; osgsv_lists then holds
// light indices, and offset and count of each cell of the grid, 1024 a row.

#ifdef OSGSV_UNIFORM
#if OSGSV_UNIFORM > 0
uniform vec4 osgsv_light[OSGSV_UNIFORM * 6];
#endif
#define OSGSV_LIGHT(light, texel) osgsv_light[(light) * 6 + texel]
#else
uniform sampler2D osgsv_lights;
uniform isampler2D osgsv_lists;
uniform ivec2 osgsv_range; // offset and count of a list
#define OSGSV_LIGHT(light, texel)                                                                  \
    texelFetch(osgsv_lights, ivec2(((light) & 255) * 6 + texel, (light) >> 8), 0)

int osgsv_list(int i)
{
    return texelFetch(osgsv_lists, ivec2(i & 1023, i >> 10), 0).r;
}
#endif

#ifdef OSGSV_MASK
float osgsv_lightLeft = 1.0; // the least that a light has left
#endif

// `type` is that of texel 0; a constant where the light is unrolled.
#ifdef OSGSV_ILLUMINANCE
vec3 osgsv_seenNormal(osgmr_Lit surface); // illuminance.frag
void osgsv_addLight(int light, float type, osgmr_Lit surface, inout vec3 ambient, inout vec3 diffuse,
                    inout vec3 specular); // likewise
#elif !defined(OSGSV_UNIFORM) || OSGSV_UNIFORM > 0
void osgsv_addLight(int light, float type, osgmr_Lit surface, inout vec3 ambient, inout vec3 diffuse,
                    inout vec3 specular)
{
    vec4 position = OSGSV_LIGHT(light, 0);
    vec4 lightAmbient = OSGSV_LIGHT(light, 1);
    vec4 lightDiffuse = OSGSV_LIGHT(light, 2);
    vec4 lightSpecular = OSGSV_LIGHT(light, 3);
    vec3 toLight = position.xyz;
    float attenuation = 1.0;
    if (type == 1.0 || type == 2.0)
    {
        toLight = position.xyz - surface.position;
        float distance = length(toLight);
        toLight = distance > 0.0 ? toLight / distance : vec3(0.0);
        float denominator =
            lightAmbient.w + distance * (lightDiffuse.w + lightSpecular.w * distance);
        attenuation = denominator > 0.0 ? min(1.0 / denominator, 1e30) : 1e30;
    }
    if (type > 1.5)
    {
        vec4 spot = OSGSV_LIGHT(light, 4);
        float exponent = OSGSV_LIGHT(light, 5).x;
        float c = dot(-toLight, spot.xyz);
        attenuation *= c < spot.w ? 0.0 : exponent == 0.0 ? 1.0 : pow(max(c, 0.0), exponent);
    }
    ambient += attenuation * lightAmbient.rgb;
    float nl = dot(surface.normal, toLight);
#ifdef OSGSV_SHADOWS
    float shadow = OSGSV_LIGHT(light, 5).y;
#ifdef OSGSV_MASK
    if (shadow >= 0.0)
        osgsv_lightLeft = min(osgsv_lightLeft, osgsv_visible(shadow, surface.position));
#else
    if (shadow >= 0.0 && nl > 0.0)
        attenuation *= osgsv_visible(shadow, surface.position);
#endif
#endif
    if (nl > 0.0)
    {
        diffuse += attenuation * nl * lightDiffuse.rgb;
#ifdef OSGMR_SPECULAR
        float nh = dot(surface.normal, normalize(toLight + surface.toEye));
        float power = surface.shininess == 0.0 ? 1.0 : nh > 0.0 ? pow(nh, surface.shininess) : 0.0;
        specular += attenuation * power * lightSpecular.rgb;
#endif
    }
}
#endif

#ifndef OSGSV_UNIFORM

void osgsv_addList(ivec2 range, osgmr_Lit surface, inout vec3 ambient, inout vec3 diffuse,
                   inout vec3 specular)
{
    for (int i = 0; i < range.y; ++i)
    {
        int light = osgsv_list(range.x + i);
        osgsv_addLight(light, OSGSV_LIGHT(light, 0).w, surface, ambient, diffuse, specular);
    }
}

#ifdef OSGSV_GRID
uniform mat3 osgsv_gridAxes;    // from eye coordinates
uniform vec3 osgsv_gridOrigin;
uniform vec3 osgsv_gridScale; // cells per unit
uniform ivec3 osgsv_gridSize;
uniform int osgsv_gridCells; // where offset and count of cell 0 lie
#endif

void osgmr_addLights(osgmr_Lit surface, inout vec3 ambient, inout vec3 diffuse, inout vec3 specular)
{
#ifdef OSGSV_ILLUMINANCE
    surface.normal = osgsv_seenNormal(surface);
#endif
    osgsv_addList(osgsv_range, surface, ambient, diffuse, specular);
#ifdef OSGSV_GRID
    ivec3 cell = ivec3(clamp((osgsv_gridAxes * surface.position - osgsv_gridOrigin) *
                                 osgsv_gridScale,
                             vec3(0.0), vec3(osgsv_gridSize - 1)));
    int at = osgsv_gridCells +
             2 * (cell.x + osgsv_gridSize.x * (cell.y + osgsv_gridSize.y * cell.z));
    osgsv_addList(ivec2(osgsv_list(at), osgsv_list(at + 1)), surface, ambient, diffuse, specular);
#endif
}
#endif
