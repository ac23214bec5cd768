// Casters as the light sees them. Depths alone are kept.
uniform mat4 osgsv_toMap; // from the caster's own coordinates to a face of a map

void main()
{
    gl_Position = osgsv_toMap * gl_Vertex;
}
