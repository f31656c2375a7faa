"""`e_Subdevice`: which part of a device a message comes from (motion-layer 2.7)."""
# ruff: noqa: N815  # the names are those that a line of a message file shows

import enum


class Subdevice(enum.IntEnum):
    """Function blocks, jobs and controllers; by the groups of their source."""

    # general and axis
    General = 0
    MainInit = 1
    fbPower = 2
    fbReset = 3
    fbResetSercos = 4
    fbHalt = 5
    fbStop = 6
    fbHome = 7
    fbJog = 8
    fbMoveVelocity1 = 9
    fbMoveVelocity2 = 10
    fbMoveAbsolute1 = 11
    fbMoveAbsolute2 = 12
    fbMoveEndless = 13
    fbMovePtP = 14
    fbMoveVelo = 15

    # CA group (sister project)
    fbCaGroup = 30
    fbMoveToPosCa = 31
    fbSendToAbsPosCa = 32
    fbSendToModuloPosCa = 33
    fbGearInPosCa = 34
    fbGroupAddAxis = 35
    fbGroupRemoveAxis = 36
    fbGroupDisable = 37
    fbGroupEnable = 38
    fbGroupErrorRead = 39
    fbGroupStatusRead = 40
    fbGroupReset = 41
    fbGroupStop = 42
    fbHaltCa = 43
    fbSendToPos = 44

    # gear
    fbGearIn = 50
    fbGearOut = 51
    fbGearInMultiMaster = 52
    fbGearInPos = 53
    fbGearInVelo = 54

    # CAM
    fbCamOut = 80
    fbCamInV2 = 81
    fbCamScalingV2 = 82
    fbCamInfoV2 = 83
    fbReadMotionFunction = 84
    fbReadMotionFunctionPoint = 85
    fbReadMotionFunctionValues = 86
    fbWriteMotionFunction = 87
    fbWriteMotionFunctionPoint = 88
    fbSetOnlineChangeMode = 89

    # parameter
    fbReadParameter = 100
    fbReadBoolParameter = 101
    fbWriteParameter = 102
    fbWriteBoolParameter = 103
    fbWriteParameterPersistent = 104

    # NCI
    fbBuildGroup = 200
    fbClearGroup = 201
    fbLoadProg = 202
    fbResetItp = 203
    fbStartStopItp = 204
    fbEStopItp = 205
    fbStepOnAfterEStopItp = 206
    fbConfirmHskItp = 207
    fbDelDtgItp = 208
    fbNciFeedTablePreparation = 209
    fbNciFeedTable = 210
    fbReadLine = 211
    fbItpReadRParams = 212
    fbItpWriteRParams = 213
    Get_ItpState = 214
    Get_Error = 215

    # XFC
    XfcPositionAtTime = 300
    XfcTimeOfPosition = 301
    XfcTimeToPosition = 302
    XfcTimeToModuloPosition = 303
    XfcRecordedPosition = 304
    XfcTouchProbe = 305
    XfcTouchProbeEL1258 = 306
    XfcTouchProbeOptions = 307
    XfcTriggerRef = 308
    XfcTriggerRef_MT = 309
    XfcEl1258Interface_MT = 310
    XfcRecordedPosition_MT = 311
    XfcTriggerOut = 312
    XfcTriggerStart = 313
    XfcSwitchOn_2252 = 314
    XfcSwitchOff_2252 = 315
    XfcInit = 316
    XfcLatchPosition = 317
    XfcWaitForPosition = 318

    # axis wrapper
    AxisMode = 1000
    AxisControl = 1001
    AxisStartUp = 1002
    AxisCycle = 1003
    AxisIdle = 1004

    # NCI wrapper
    NciControl = 2000
    NciStartUp = 2001
    NciCycle = 2002
    NciIdle = 2003

    # flying saw
    FlyingSawControl = 2100
    FlyingSawStartUp = 2101

    # station (sister project)
    StationLinkedList = 3000
    StationInitList = 3001
    StationAddHead = 3002
    StationAddTail = 3003
    StationGetHead = 3004
    StationRemoveHeadValue = 3005
    StationGearInDistanceToSync = 3006
    StationGearInSyncStart = 3007
    StationGearInSyncMove = 3008
    StationGearInSyncEnd = 3009
    StationCalcInfeedPosition = 3010
    StationControl = 4000
    StationState = 4001

    # XPU / transport (sister project)
    Xpu_fbEnvironment = 5000
    Xpu_fbProcessingUnit = 5001
    Xpu_fbXpuPart = 5002
    Xpu_fbXpuTrack = 5003
    Xpu_fbMc2CaGroup = 5004
    Xpu_fbParameterSet = 5005
    Xpu_fbNctController = 5006
    Xpu_fbPartModules = 5500
    Xpu_fbMoverXpu = 6000
    Xpu_fbNctBaseUnit = 6500
    TransportUnit_General = 7000
    TransportUnit_Restart = 7010
    TransportUnit_Start = 7011
    TransportUnit_XpuInit = 7012
    TransportUnit_StationClearOutfeed = 7013

    # CAM wrapper
    CamControl = 8000
    CamStartUp = 8001
    CamCycle = 8002

    # process
    Process_StationCollector = 11000
    Process_ProcessCollector = 11100
    Process_ProcessCollector_Init = 11101
    Process_ProcessCollector_Cycle = 11102
    Process_ProcessCollector_Control = 11103
    Process_LinkedList_GetHead = 11104
    Process_LinkedList_RemoveHead = 11105
    Process_LinkedList_AddTail = 11106
    Process_LinkedList_CheckData = 11107
    Process_StationQueue_Check = 11108
    Process_LinkedList_Com = 11200
    Process_LinkedList_Com_Init = 11201
    Process_LinkedList_Com_Cmd = 11202
    Process_LinkedList_Com_AddHead = 11203
    Process_LinkedList_Com_AddTail = 11204
    Process_LinkedList_Com_DelHead = 11205
    Process_LinkedList_Com_DelTail = 11206
    Process_LinkedList_Com_GetHead = 11207
    Process_LinkedList_Com_GetTail = 11208

    # instance / ticket
    Instance_Command = 12000
    Instance_ProcessConductor = 12001
    Instance_BufferInfeed = 12002
    Instance_Infeed = 12003
    Instance_BufferOutfeed = 12004
    Instance_Outfeed = 12005
    Instance_Sender_Buffer = 12006
    Ticket_LinkedList_Ctrl = 12100
    Ticket_LinkedList_Com_Init = 12101
    Ticket_LinkedList_Com_Cmd = 12102
    Ticket_LinkedList_Com_AddHead = 12103
    Ticket_LinkedList_Com_AddTail = 12104
    Ticket_LinkedList_Com_DelHead = 12105
    Ticket_LinkedList_Com_DelTail = 12106
    Ticket_LinkedList_Com_GetHead = 12107
    Ticket_LinkedList_Com_GetTail = 12108

    # application
    Application = 13000
    Application_Check = 13001
    Application_Clear = 13002
    Application_Cmd = 13003
    Application_Disable = 13004
    Application_Enable = 13005
    Application_Finish = 13006
    Application_Init = 13007
    Application_Proceed = 13008
    Application_Work = 13009
