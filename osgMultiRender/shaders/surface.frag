// The fragment half of a surface function: osgmr_surface() returns the colour of this fragment.
// Which parts exist is said by the OSGMR_* defines of the variant; generated code defines
// osgmr_textures(), a kit's snippet osgmr_addLights().

vec4 osgmr_textures(vec4 primary);

#ifdef OSGMR_LIGHTING_PIXEL
OSGMR_FLAT in vec3 osgmr_normal;
OSGMR_FLAT in vec4 osgmr_color;
in vec3 osgmr_position;

// What lights act on. Directions are unit vectors in eye coordinates; the normal is the zero vector
// where the model has none, and then only ambient light and emission show.
struct osgmr_Lit
{
    vec3 position;
    vec3 normal;
    vec3 toEye;
    float shininess;
};

// Adds the light that arrives at the surface to the three sums, which the material then weighs.
void osgmr_addLights(osgmr_Lit surface, inout vec3 ambient, inout vec3 diffuse, inout vec3 specular);

vec4 osgmr_lit(gl_MaterialParameters material, vec3 normal, out vec3 specular)
{
#if OSGMR_COLOR_MODE == 1 || OSGMR_COLOR_MODE == 5
    material.ambient = osgmr_color;
#endif
#if OSGMR_COLOR_MODE == 2 || OSGMR_COLOR_MODE == 5
    material.diffuse = osgmr_color;
#endif
#if OSGMR_COLOR_MODE == 3
    material.specular = osgmr_color;
#endif
#if OSGMR_COLOR_MODE == 4
    material.emission = osgmr_color;
#endif
    float size = length(normal);
    osgmr_Lit lit;
    lit.position = osgmr_position;
    lit.normal = size > 0.0 ? normal / size : vec3(0.0);
#ifdef OSGMR_LOCAL_VIEWER
    lit.toEye = normalize(-osgmr_position);
#else
    lit.toEye = vec3(0.0, 0.0, 1.0);
#endif
    lit.shininess = material.shininess;
    vec3 ambientLight = gl_LightModel.ambient.rgb;
    vec3 diffuseLight = vec3(0.0);
    vec3 specularLight = vec3(0.0);
    osgmr_addLights(lit, ambientLight, diffuseLight, specularLight);
    specular = specularLight * material.specular.rgb;
    vec3 color = material.emission.rgb + ambientLight * material.ambient.rgb +
                 diffuseLight * material.diffuse.rgb;
#ifndef OSGMR_SEPARATE_SPECULAR
    color += specular;
#endif
    return clamp(vec4(color, material.diffuse.a), 0.0, 1.0);
}
#endif

vec4 osgmr_surface()
{
#if defined(OSGMR_LIGHTING_PIXEL)
    vec3 specular;
    vec4 color;
#ifdef OSGMR_TWO_SIDED
    if (!gl_FrontFacing)
        color = osgmr_lit(gl_MaterialParameters(gl_BackMaterial.emission, gl_BackMaterial.ambient,
                                                gl_BackMaterial.diffuse, gl_BackMaterial.specular,
                                                gl_BackMaterial.shininess),
                          -osgmr_normal, specular);
    else
#endif
        color = osgmr_lit(gl_FrontMaterial, osgmr_normal, specular);
#else
    vec4 color = gl_Color;
#endif
    color = osgmr_textures(color);
#ifdef OSGMR_SEPARATE_SPECULAR
#ifdef OSGMR_LIGHTING_PIXEL
    color.rgb = clamp(color.rgb + specular, 0.0, 1.0);
#else
    color.rgb = clamp(color.rgb + gl_SecondaryColor.rgb, 0.0, 1.0);
#endif
#elif defined(OSGMR_COLOR_SUM)
    color.rgb = clamp(color.rgb + gl_SecondaryColor.rgb, 0.0, 1.0);
#endif
#ifdef OSGMR_FOG
#if OSGMR_FOG == 1
    float fog = (gl_Fog.end - gl_FogFragCoord) * gl_Fog.scale;
#elif OSGMR_FOG == 2
    float fog = exp(-gl_Fog.density * gl_FogFragCoord);
#else
    float fog = exp(-(gl_Fog.density * gl_FogFragCoord) * (gl_Fog.density * gl_FogFragCoord));
#endif
    color.rgb = mix(gl_Fog.color.rgb, color.rgb, clamp(fog, 0.0, 1.0));
#endif
    return color;
}
