"""A small scene for the tests of the commands."""

from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]

#: A cube whose side towards the camera is a hole: one sees the inside of the far side through it.
CUBE = """#usda 1.0
(
    upAxis = "Y"
    startTimeCode = 1
    endTimeCode = 3
)

def Xform "World"
{
    def Camera "Near"
    {
        float focalLength = 35
        float horizontalAperture = 36
        float verticalAperture = 24
        float2 clippingRange = (0.1, 100)
        double3 xformOp:translate.timeSamples = { 1: (0, 0, 5), 3: (0, 0, 9) }
        uniform token[] xformOpOrder = ["xformOp:translate"]
    }
    def Camera "Square"
    {
        float horizontalAperture = 24
        float verticalAperture = 24
        double3 xformOp:translate = (0, 0, 9)
        uniform token[] xformOpOrder = ["xformOp:translate"]
    }
    def Mesh "Cube"
    {
        uniform token subdivisionScheme = "catmullClark"
        uniform bool doubleSided = 1
        float3[] extent = [(-1, -1, -1), (1, 1, 1)]
        int[] faceVertexCounts = [4, 4, 4, 4, 4, 4]
        int[] faceVertexIndices = [0,1,3,2, 2,3,5,4, 4,5,7,6, 6,7,1,0, 1,7,5,3, 6,0,2,4]
        point3f[] points = [(-1,-1,1),(1,-1,1),(-1,1,1),(1,1,1),
                            (-1,1,-1),(1,1,-1),(-1,-1,-1),(1,-1,-1)]
        int[] holeIndices = [HOLES]
        color3f[] primvars:displayColor = [(1, 0.5, 0.25)]
    }
    def Mesh "Broken"
    {
        token visibility = "BROKEN"
        int[] faceVertexCounts = [4]
        int[] faceVertexIndices = [0, 1, 2, 9]
        point3f[] points = [(0, 0, 0), (1, 0, 0), (1, 1, 0)]
    }
    def RenderSettings "Settings"
    {
        rel camera = </World/Square>
        uniform int2 resolution = (40, 30)
        int hdcc:samples = 1
    }
}
"""


def cube(holes: str = "", broken: bool = False) -> str:
    """The text of the scene."""
    text = CUBE.replace("HOLES", holes)
    return text.replace("BROKEN", "inherited" if broken else "invisible")
