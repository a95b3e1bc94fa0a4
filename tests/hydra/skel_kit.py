"""A mesh with a skeleton."""

from pxr import Gf, Usd, UsdGeom, UsdSkel


def skin(stage: Usd.Stage, mesh: UsdGeom.Mesh) -> UsdSkel.Animation:
    """Binds a mesh below /Root to one joint, and to a blend shape that moves it by 1 along x."""
    UsdSkel.Root.Define(stage, "/Root")
    skeleton = UsdSkel.Skeleton.Define(stage, "/Root/Skeleton")
    skeleton.CreateJointsAttr(["joint"])
    skeleton.CreateBindTransformsAttr([Gf.Matrix4d(1)])
    skeleton.CreateRestTransformsAttr([Gf.Matrix4d(1)])
    UsdSkel.BindingAPI.Apply(skeleton.GetPrim()).CreateAnimationSourceRel().SetTargets(
        ["/Root/Animation"]
    )
    shape = UsdSkel.BlendShape.Define(stage, mesh.GetPath().AppendChild("shift"))
    shape.CreateOffsetsAttr([(1, 0, 0)] * len(mesh.GetPointsAttr().Get()))
    binding = UsdSkel.BindingAPI.Apply(mesh.GetPrim())
    binding.CreateSkeletonRel().SetTargets(["/Root/Skeleton"])
    binding.CreateJointIndicesPrimvar(True, 1).Set([0])
    binding.CreateJointWeightsPrimvar(True, 1).Set([1.0])
    binding.CreateBlendShapesAttr(["shift"])
    binding.CreateBlendShapeTargetsRel().SetTargets([shape.GetPath()])
    animation = UsdSkel.Animation.Define(stage, "/Root/Animation")
    animation.CreateJointsAttr(["joint"])
    animation.CreateTranslationsAttr([(0, 0, 0)])
    animation.CreateRotationsAttr([Gf.Quatf(1)])
    animation.CreateScalesAttr([Gf.Vec3h(1)])
    animation.CreateBlendShapesAttr(["shift"])
    animation.CreateBlendShapeWeightsAttr([0.0])
    return animation
