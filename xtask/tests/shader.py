"""OpenColorIO's shaders, run on whatever OpenGL the machine has; Mesa's llvmpipe needs no graphics card.

Needs opencolorio 2, moderngl and numpy.
"""

import moderngl
import numpy
import PyOpenColorIO as ocio

VERTICES = """
#version 400
void main() {
    gl_Position = vec4(vec2(gl_VertexID & 1, gl_VertexID >> 1) * 4.0 - 1.0, 0.0, 1.0);
}
"""

FRAGMENT = """
#version 400
uniform sampler2D inputs;
layout(location = 0) out vec4 colour;
{function}
void main() {{
    colour = OCIOMain(texelFetch(inputs, ivec2(gl_FragCoord.xy), 0));
}}
"""


def apply(processor, inputs):
    """What the shader of a processor makes of colours (n, 3), in 32-bit floats; moderngl.Error where it does not compile."""
    description = ocio.GpuShaderDesc.CreateShaderDesc(language=ocio.GPU_LANGUAGE_GLSL_4_0)
    # moderngl has no textures of one dimension.
    description.setAllowTexture1D(False)
    processor.getDefaultGPUProcessor().extractGpuShaderInfo(description)
    context = moderngl.create_standalone_context(backend="egl")
    try:
        program = context.program(VERTICES, FRAGMENT.format(function=description.getShaderText()))
        width = 256
        height = -(-len(inputs) // width)
        pixels = numpy.zeros((height * width, 4), numpy.float32)
        pixels[: len(inputs), :3] = inputs
        textures = {"inputs": nearest(context.texture((width, height), 4, pixels.tobytes(), dtype="f4"))}
        for table in description.getTextures():
            components = 3 if table.channel == ocio.GpuShaderCreator.TEXTURE_RGB_CHANNEL else 1
            data = numpy.asarray(table.getValues(), numpy.float32).tobytes()
            texture = context.texture((table.width, table.height), components, data, dtype="f4")
            textures[table.samplerName] = filtered(texture, table.interpolation)
        for table in description.get3DTextures():
            data = numpy.asarray(table.getValues(), numpy.float32).tobytes()
            texture = context.texture3d((table.edgeLen,) * 3, 3, data, dtype="f4")
            texture.repeat_z = False
            textures[table.samplerName] = filtered(texture, table.interpolation)
        for unit, (name, texture) in enumerate(textures.items()):
            texture.use(unit)
            program[name] = unit
        target = context.texture((width, height), 4, dtype="f4")
        frame = context.framebuffer([target])
        frame.use()
        context.vertex_array(program, []).render(moderngl.TRIANGLE_STRIP, vertices=4)
        result = numpy.frombuffer(target.read(), numpy.float32).reshape(-1, 4)
        return result[: len(inputs), :3].copy(), context.info["GL_RENDERER"]
    finally:
        context.release()


def filtered(texture, interpolation):
    """The filter that OpenColorIO asks for, and the ends of the table outside it."""
    nearest(texture)
    if interpolation != ocio.INTERP_NEAREST:
        texture.filter = (moderngl.LINEAR, moderngl.LINEAR)
    return texture


def nearest(texture):
    texture.filter = (moderngl.NEAREST, moderngl.NEAREST)
    texture.repeat_x = texture.repeat_y = False
    return texture
