// What the solids of a traced scene are made of; a row for each kind of material.
uniform vec3 material_diffuse[MATERIALS];
uniform vec3 material_specular[MATERIALS];
uniform float material_shininess[MATERIALS];
// Emissive and ambient terms, seen from outside:
uniform vec3 material_front[MATERIALS];
uniform vec3 material_back[MATERIALS];
#if GREY                   // every share of light is the same in red, green and blue
#define Share float
uniform float material_reflectance[MATERIALS];
uniform float material_transmittance[MATERIALS];
#else
#define Share vec3
uniform vec3 material_reflectance[MATERIALS];
uniform vec3 material_transmittance[MATERIALS];
#endif
uniform float material_index[MATERIALS];
#if ABSORPTION
uniform vec3 material_absorption[MATERIALS];
#endif

#if MEDIA > 0              // solids of glass by falling priority, and air
uniform float medium_index[MEDIA + 1];
uniform vec3 medium_absorption[MEDIA + 1];
#endif

uniform vec3 background;
uniform float threshold;

#if TEXTURES > 0
uniform sampler2D texels[TEXTURES];
#endif
