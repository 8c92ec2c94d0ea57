using UnrealBuildTool;

public class DermisSkin : ModuleRules
{
    public DermisSkin(ReadOnlyTargetRules Target) : base(Target)
    {
        PCHUsage = PCHUsageMode.UseExplicitOrSharedPCHs;
        PrivateDependencyModuleNames.AddRange(new string[] { "Core", "Projects", "RenderCore" });
    }
}
