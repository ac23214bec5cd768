// A vertex of a volume whose silhouette was found on the CPU; w = 0 says that it is extruded.

uniform vec4 osgsv_localLight;
uniform vec3 osgsv_lightRest;
uniform float osgsv_end;    // w of extrusions: 0 at infinity
uniform float osgsv_handedness;
uniform float osgsv_weight; // of what is drawn: Silhouette::Sides, 1 for caps

invariant gl_Position;
flat out float osgsv_multiplicity;

void main()
{
    osgsv_multiplicity = osgsv_weight * osgsv_handedness;
    if (gl_Vertex.w != 0.0)
        gl_Position = ftransform();
    else
    {
        vec3 away = (gl_Vertex.xyz * osgsv_localLight.w - osgsv_localLight.xyz) - osgsv_lightRest;
        gl_Position =
            gl_ModelViewProjectionMatrix * vec4(away + gl_Vertex.xyz * osgsv_end, osgsv_end);
    }
}
