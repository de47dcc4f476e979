// Writes what a chain does in Unreal, frame by frame, for `tendril trace`. Copy it into your module's Public
// folder and call it after the animation is evaluated, from C++ or as a Blueprint node.
//
//   UTendrilTrace::WriteChain(TEXT("arm.jsonl"), GetMesh(), {"upperarm_r", "lowerarm_r", "hand_r"}, Target, Pole);
//
// Writes: {"t": 0.5, "joints": [[0, 0, 140], [28, 0, 138], [52, 3, 130]], "target": [60, 0, 130], "pole": [30, -50, 140]}
#pragma once

#include "Components/SkeletalMeshComponent.h"
#include "HAL/PlatformTime.h"
#include "Kismet/BlueprintFunctionLibrary.h"
#include "Misc/FileHelper.h"
#include "Misc/Paths.h"

#include "TendrilTrace.generated.h"

UCLASS()
class UTendrilTrace : public UBlueprintFunctionLibrary
{
    GENERATED_BODY()

public:
    /** Adds a frame to Saved/<File>, in world space. Bones from the root to the tip. */
    UFUNCTION(BlueprintCallable, Category = "Tendril")
    static void WriteChain(const FString& File, USkeletalMeshComponent* Mesh, const TArray<FName>& Bones,
                           FVector Target, FVector Pole)
    {
        const FString Path = FPaths::ProjectSavedDir() / File;
        FString Line;
        static TSet<FString> Begun;
        if (!Begun.Contains(Path))
        {
            Begun.Add(Path);
            FFileHelper::SaveStringToFile(
                FString(TEXT("{\"tendril\": \"trace\", \"up\": \"z\", \"handed\": \"left\", \"unit\": \"cm\"}\n")), *Path);
        }
        Line = FString::Printf(TEXT("{\"t\": %.6f, \"joints\": ["), FPlatformTime::Seconds());
        for (int32 Bone = 0; Bone < Bones.Num(); ++Bone)
            Line += (Bone > 0 ? TEXT(", ") : TEXT("")) + Point(Mesh->GetSocketLocation(Bones[Bone]));
        Line += TEXT("], \"target\": ") + Point(Target) + TEXT(", \"pole\": ") + Point(Pole) + TEXT("}\n");
        FFileHelper::SaveStringToFile(Line, *Path, FFileHelper::EEncodingOptions::ForceUTF8WithoutBOM,
                                      &IFileManager::Get(), FILEWRITE_Append);
    }

private:
    static FString Point(const FVector& P) { return FString::Printf(TEXT("[%.6f, %.6f, %.6f]"), P.X, P.Y, P.Z); }
};
