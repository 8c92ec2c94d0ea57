// Makes the plugin's Shaders folder known as /Plugin/DermisSkin, for the includes of Custom nodes.

#include "Interfaces/IPluginManager.h"
#include "Misc/Paths.h"
#include "Modules/ModuleManager.h"
#include "ShaderCore.h"

class FDermisSkinModule : public IModuleInterface {
  public:
    virtual void StartupModule() override {
        const FString Folder = IPluginManager::Get().FindPlugin(TEXT("DermisSkin"))->GetBaseDir();
        AddShaderSourceDirectoryMapping(TEXT("/Plugin/DermisSkin"), FPaths::Combine(Folder, TEXT("Shaders")));
    }
};

IMPLEMENT_MODULE(FDermisSkinModule, DermisSkin)
