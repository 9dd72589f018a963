// textureOffset and texelFetchOffset; textureProj divides.
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = fragCoord / iResolution.xy;
    fragColor = textureOffset(iChannel0, uv, ivec2(3, -2)) * 0.5
              + texelFetchOffset(iChannel0, ivec2(uv * 12.0), 0, ivec2(1, 1)) * 0.3
              + textureProj(iChannel0, vec3(uv, 2.0)) * 0.2;
}
