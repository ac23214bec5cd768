// A vertex of a caster for the stages that find its silhouette: where it is, and where its
// extrusion away from the light is. Both are computed here only, so that sides and caps meet.

uniform vec4 osgsv_localLight;
uniform vec3 osgsv_lightRest;
uniform float osgsv_end; // w of extrusions: 0 at infinity

invariant gl_Position;
flat out int osgsv_index;
out vec3 osgsv_position;
out vec4 osgsv_extruded;

void main()
{
    osgsv_index = gl_VertexID;
    osgsv_position = gl_Vertex.xyz;
    gl_Position = ftransform();
    precise vec3 away =
        (gl_Vertex.xyz * osgsv_localLight.w - osgsv_localLight.xyz) - osgsv_lightRest;
    precise vec4 extruded =
        gl_ModelViewProjectionMatrix * vec4(away + gl_Vertex.xyz * osgsv_end, osgsv_end);
    osgsv_extruded = extruded;
}
