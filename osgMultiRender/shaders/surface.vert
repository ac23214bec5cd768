// The vertex half of a surface function. Which parts exist is said by the OSGMR_* defines of the
// variant; generated code defines osgmr_texCoords() and, with vertex lighting, osgmr_lights().

#ifdef OSGMR_LIGHTING_PIXEL
OSGMR_FLAT out vec3 osgmr_normal;
OSGMR_FLAT out vec4 osgmr_color;
out vec3 osgmr_position;
#endif

// Passes that draw the same surface by other programs cover the same pixels at the same depths.
invariant gl_Position;

#ifdef OSGMR_INSTANCE
// One vertex array is drawn many times: a VertexSnippet says where.
vec4 OSGMR_VERTEX = gl_Vertex;
vec3 OSGMR_NORMAL = gl_Normal;
vec4 OSGMR_COLOR = gl_Color;
void osgmr_instance(inout vec4 vertex, inout vec3 normal, inout vec4 color);
#else
#define OSGMR_VERTEX gl_Vertex
#define OSGMR_NORMAL gl_Normal
#define OSGMR_COLOR gl_Color
#endif

vec4 osgmr_eye;     // position in eye coordinates
vec3 osgmr_vNormal; // normal in eye coordinates, scaled as the state says

void osgmr_texCoords();

#ifdef OSGMR_LIGHTING_VERTEX
void osgmr_lights(vec3 normal, float shininess);

vec3 osgmr_ambientLight, osgmr_diffuseLight, osgmr_specularLight;

// One light of GL's own, OpenGL 2.1 specification, section 2.14.1. type: 1 directional, 2 point,
// 3 spot, 4 directional with a cone.
void osgmr_addLight(gl_LightSourceParameters light, int type, vec3 normal, float shininess)
{
    vec3 toLight;
    float attenuation = 1.0;
    if (type == 1 || type == 4)
        toLight = normalize(light.position.xyz);
    else
    {
        vec3 d = light.position.xyz / light.position.w - osgmr_eye.xyz;
        float distance = length(d);
        toLight = distance > 0.0 ? d / distance : vec3(0.0);
        attenuation = 1.0 / (light.constantAttenuation + distance *
                             (light.linearAttenuation + light.quadraticAttenuation * distance));
    }
    if (type >= 3)
    {
        float c = dot(-toLight, normalize(light.spotDirection));
        attenuation *= c < light.spotCosCutoff ? 0.0
                       : light.spotExponent == 0.0 ? 1.0 : pow(max(c, 0.0), light.spotExponent);
    }
    float nl = dot(normal, toLight);
    osgmr_ambientLight += attenuation * light.ambient.rgb;
    if (nl > 0.0)
    {
        osgmr_diffuseLight += attenuation * nl * light.diffuse.rgb;
#ifdef OSGMR_SPECULAR
#ifdef OSGMR_LOCAL_VIEWER
        vec3 toEye = normalize(-osgmr_eye.xyz);
#else
        vec3 toEye = vec3(0.0, 0.0, 1.0);
#endif
        float nh = dot(normal, normalize(toLight + toEye));
        float power = shininess == 0.0 ? 1.0 : nh > 0.0 ? pow(nh, shininess) : 0.0;
        osgmr_specularLight += attenuation * power * light.specular.rgb;
#endif
    }
}

void osgmr_shade(gl_MaterialParameters material, vec3 normal, out vec4 primary, out vec4 secondary)
{
#if OSGMR_COLOR_MODE == 1 || OSGMR_COLOR_MODE == 5
    material.ambient = OSGMR_COLOR;
#endif
#if OSGMR_COLOR_MODE == 2 || OSGMR_COLOR_MODE == 5
    material.diffuse = OSGMR_COLOR;
#endif
#if OSGMR_COLOR_MODE == 3
    material.specular = OSGMR_COLOR;
#endif
#if OSGMR_COLOR_MODE == 4
    material.emission = OSGMR_COLOR;
#endif
    osgmr_ambientLight = gl_LightModel.ambient.rgb;
    osgmr_diffuseLight = vec3(0.0);
    osgmr_specularLight = vec3(0.0);
    osgmr_lights(normal, material.shininess);
    vec3 color = material.emission.rgb + osgmr_ambientLight * material.ambient.rgb +
                 osgmr_diffuseLight * material.diffuse.rgb;
    vec3 specular = osgmr_specularLight * material.specular.rgb;
#ifdef OSGMR_SEPARATE_SPECULAR
    secondary = vec4(clamp(specular, 0.0, 1.0), 0.0);
#else
    color += specular;
    secondary = vec4(0.0);
#endif
    primary = vec4(clamp(color, 0.0, 1.0), clamp(material.diffuse.a, 0.0, 1.0));
}
#endif

void osgmr_vertex()
{
#ifdef OSGMR_INSTANCE
    osgmr_instance(OSGMR_VERTEX, OSGMR_NORMAL, OSGMR_COLOR);
#endif
#ifdef OSGMR_EYE
    osgmr_eye = gl_ModelViewMatrix * OSGMR_VERTEX;
    osgmr_eye.xyz /= osgmr_eye.w;
#endif
#ifdef OSGMR_NORMALS
    osgmr_vNormal = gl_NormalMatrix * OSGMR_NORMAL;
#if defined(OSGMR_NORMALIZE) && defined(OSGMR_LIGHTING_PIXEL)
    // A zero normal stays zero: NaN would spread over its triangles.
    float size = length(osgmr_vNormal);
    osgmr_vNormal = size > 0.0 ? osgmr_vNormal / size : vec3(0.0);
#elif defined(OSGMR_NORMALIZE)
    osgmr_vNormal = normalize(osgmr_vNormal);
#elif defined(OSGMR_RESCALE)
    osgmr_vNormal *= gl_NormalScale;
#endif
#endif
#if defined(OSGMR_LIGHTING_VERTEX)
    osgmr_shade(gl_FrontMaterial, osgmr_vNormal, gl_FrontColor, gl_FrontSecondaryColor);
#ifdef OSGMR_TWO_SIDED
    osgmr_shade(gl_MaterialParameters(gl_BackMaterial.emission, gl_BackMaterial.ambient,
                                      gl_BackMaterial.diffuse, gl_BackMaterial.specular,
                                      gl_BackMaterial.shininess),
                -osgmr_vNormal, gl_BackColor, gl_BackSecondaryColor);
#endif
#elif defined(OSGMR_LIGHTING_PIXEL)
    osgmr_normal = osgmr_vNormal;
    osgmr_color = OSGMR_COLOR;
    osgmr_position = osgmr_eye.xyz;
#else
    gl_FrontColor = OSGMR_COLOR;
#ifdef OSGMR_COLOR_SUM
    gl_FrontSecondaryColor = gl_SecondaryColor;
#endif
#endif
    osgmr_texCoords();
#if defined(OSGMR_FOG_COORDINATE)
    gl_FogFragCoord = gl_FogCoord;
#elif defined(OSGMR_FOG)
    gl_FogFragCoord = abs(osgmr_eye.z);
#endif
#ifdef OSGMR_CLIP
    gl_ClipVertex = gl_ModelViewMatrix * OSGMR_VERTEX;
#endif
#ifdef OSGMR_INSTANCE
    gl_Position = gl_ModelViewProjectionMatrix * OSGMR_VERTEX;
#else
    gl_Position = ftransform();
#endif
}
